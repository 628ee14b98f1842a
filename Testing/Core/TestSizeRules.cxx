// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests rules for sizes: their texts, levels, names and places.
#include "Octree/Sizing/SizeRules.h"
#include "SizingFrame.h"
#include "Support/Error.h"
#include "Support/Shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;

TEST(Levels, AreThoseOfTheLargestOctantsThatAreNotAboveASize)
{
  const GridFrame frame = frameOf(4);
  EXPECT_EQ(levelNotAbove(1e9, frame), 0);
  for (int level = 0; level <= 4; ++level)
  {
    const double size = frame.sizeOf(level);
    EXPECT_EQ(levelNotAbove(size, frame), level);
    EXPECT_EQ(levelNotAbove(1.9 * size, frame), level);
    EXPECT_EQ(levelNotAbove(size * (1.0 - 1e-12), frame), level) << "rounding counts for nothing";
    EXPECT_EQ(levelNotAbove(size * (1.0 - 1e-6), frame), std::min(level + 1, 4));
  }
  EXPECT_EQ(levelNotAbove(1e-9, frame), 4);
}

TEST(Levels, KnowTheNarrowestSideOfAPrismOnly)
{
  EXPECT_EQ(narrowestSide(PlacedBox{Placement(), {Vec3(0, 0, 0), Vec3(1, 2, 3)}}),
            std::numeric_limits<double>::infinity());
  const PlacedPrism prism(Placement(), {Vec2(0, 0), Vec2(7, 0), Vec2(7, 3), Vec2(4, 7)}, 0.0, 1.0);
  EXPECT_NEAR(narrowestSide(prism), 3.0, 1e-12);
}

TEST(SizeTexts, AreReadOrRefused)
{
  const SurfaceSize one = surfaceSizeFrom("Wall* 0.5");
  EXPECT_EQ(one.pattern, "Wall*");
  EXPECT_EQ(one.size, 0.5);
  EXPECT_FALSE(one.featureSize);
  EXPECT_EQ(surfaceSizeFrom("Wall 0.5 0.25").featureSize, 0.25);
  for (const char* wrong : {"", "Wall", "Wall x", "Wall 1 2 3", "Wall 1 x"})
  {
    EXPECT_THROW(surfaceSizeFrom(wrong), Error) << wrong;
  }
  const std::vector<DistanceSize> two = distanceSizesFrom("\"a b\" 1 0.5 3 2");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[1].pattern, "a b");
  EXPECT_EQ(two[0].distance, 1.0);
  EXPECT_EQ(two[0].size, 0.5);
  EXPECT_EQ(two[1].distance, 3.0);
  EXPECT_EQ(two[1].size, 2.0);
  for (const char* wrong : {"", "Wall", "Wall 1", "Wall 1 2 3", "Wall 1 x"})
  {
    EXPECT_THROW(distanceSizesFrom(wrong), Error) << wrong;
  }
}

TEST(FinestSize, IsTheSmallestOfAllRules)
{
  SizingOptions options;
  EXPECT_EQ(finestSizeOf(options), std::numeric_limits<double>::infinity());
  options.surfaceSizes = {{"A", 4.0, {}}};
  EXPECT_EQ(finestSizeOf(options), 4.0);
  options.surfaceSizes.push_back({"B", 5.0, 3.0});
  EXPECT_EQ(finestSizeOf(options), 3.0);
  options.boxes = {{{}, 2.0}};
  EXPECT_EQ(finestSizeOf(options), 2.0);
  options.distanceSizes = {{"C", 0.1, 1.0}};
  EXPECT_EQ(finestSizeOf(options), 1.0);
}

TEST(FinestSize, IsRefusedUnlessPositive)
{
  const double nan = std::nan("");
  for (const double wrong : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
  {
    std::array<SizingOptions, 4> options;
    options[0].surfaceSizes = {{"A", wrong, {}}};
    options[1].surfaceSizes = {{"A", 1.0, wrong}};
    options[2].boxes = {{{}, wrong}};
    options[3].distanceSizes = {{"A", 1.0, wrong}};
    for (const SizingOptions& o : options)
    {
      EXPECT_THROW(finestSizeOf(o), Error) << wrong;
    }
  }
}

/// A model of random triangles on a few points, some of whose pairs of points are feature edges.
SurfaceModel randomModel(unsigned seed)
{
  std::mt19937 random(seed);
  constexpr Index count = 8;
  SurfaceModel model;
  model.names = {"S0", "S1", "T0"};
  model.points.resize(count);
  for (int t = 0; t < 12; ++t)
  {
    std::array<Index, count> order{};
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::shuffle(order, random);
    model.triangles.push_back({order[0], order[1], order[2]});
    model.surfaceIds.push_back(t == 11 ? 3 + xMax : static_cast<Index>(random() % 3));
  }
  for (Index a = 0; a < count; ++a)
  {
    for (Index b = 0; b < a; ++b)
    {
      if (random() % 3 == 0)
      {
        model.featureEdges.push_back(random() % 2 ? FeatureEdge{a, b, 0} : FeatureEdge{b, a, 0});
      }
    }
  }
  model.corners = {6, 1, 3};
  return model;
}

/// The finest feature level of the surfaces that have a triangle with both ends of an edge.
int levelOfEdge(const SurfaceModel& model, const FeatureEdge& edge, const std::vector<int>& featureOfSurface)
{
  int level = 0;
  for (std::size_t t = 0; t < model.triangles.size(); ++t)
  {
    const auto& points = model.triangles[t];
    const bool has = std::ranges::count(points, edge.a) > 0 && std::ranges::count(points, edge.b) > 0;
    level = std::max(level, has ? featureOfSurface[model.surfaceIds[t]] : 0);
  }
  return level;
}

TEST(ModelLevels, OfCurvesAndCornersAreTheFinestOfTheirSurfaces)
{
  GridFrame frame = frameOf(6);
  frame.midLevel = 2;
  frame.featureLevel = 3;
  SizingOptions options;
  options.surfaceSizes = {{"S*", 16.0, {}}, {"S1", 4.0, 2.0}};
  for (unsigned seed = 1; seed <= 20; ++seed)
  {
    const SurfaceModel model = randomModel(seed);
    const ModelLevels levels = modelLevels(model, frame, options);
    for (std::size_t e = 0; e < model.featureEdges.size(); ++e)
    {
      EXPECT_EQ(levels.ofFeatureEdge[e], levelOfEdge(model, model.featureEdges[e], levels.featureOfSurface));
    }
    for (std::size_t c = 0; c < model.corners.size(); ++c)
    {
      int finest = 0;
      for (std::size_t e = 0; e < model.featureEdges.size(); ++e)
      {
        const FeatureEdge& edge = model.featureEdges[e];
        const bool isAt = edge.a == model.corners[c] || edge.b == model.corners[c];
        finest = std::max(finest, isAt ? levels.ofFeatureEdge[e] : 0);
      }
      EXPECT_EQ(levels.ofCorner[c], finest);
    }
  }
}

TEST(ModelLevels, OfSurfacesAreThoseOfTheFinestRuleOrTheFrame)
{
  GridFrame frame = frameOf(6); // sizes of 64 m at level 0 to 1 m at level 6
  frame.midLevel = 2;
  frame.featureLevel = 3;
  const SurfaceModel model = randomModel(1);
  const auto levelsOf = [&](const std::vector<SurfaceSize>& rules) {
    SizingOptions options;
    options.surfaceSizes = rules;
    const ModelLevels levels = modelLevels(model, frame, options);
    EXPECT_EQ(levels.ofSurface.size(), 3U + sideNumbers);
    EXPECT_EQ(levels.featureOfSurface.size(), 3U + sideNumbers);
    EXPECT_EQ(std::accumulate(levels.ofSurface.begin() + 3, levels.ofSurface.end(), 0), 0);
    EXPECT_EQ(std::accumulate(levels.featureOfSurface.begin() + 3, levels.featureOfSurface.end(), 0), 0);
    std::vector<int> all(levels.ofSurface.begin(), levels.ofSurface.begin() + 3);
    all.insert(all.end(), levels.featureOfSurface.begin(), levels.featureOfSurface.begin() + 3);
    return all;
  };
  EXPECT_THAT(levelsOf({}), ElementsAre(2, 2, 2, 3, 3, 3));
  EXPECT_THAT(levelsOf({{"T0", 64.0, {}}}), ElementsAre(2, 2, 0, 3, 3, 3)) << "a rule may be coarser";
  EXPECT_THAT(levelsOf({{"T0", 64.0, 32.0}}), ElementsAre(2, 2, 0, 3, 3, 1));
  EXPECT_THAT(levelsOf({{"T0", 4.0, {}}}), ElementsAre(2, 2, 4, 3, 3, 4)) << "features are no coarser";
  EXPECT_THAT(levelsOf({{"T0", 4.0, 64.0}}), ElementsAre(2, 2, 4, 3, 3, 4));
  const std::vector<SurfaceSize> several{{"S*", 8.0, 8.0}, {"*0", 4.0, 2.0}, {"S1", 32.0, 16.0}};
  EXPECT_THAT(levelsOf(several), ElementsAre(4, 3, 4, 5, 3, 5));
  EXPECT_THAT(levelsOf({several.rbegin(), several.rend()}), ElementsAre(4, 3, 4, 5, 3, 5));
  EXPECT_THROW(levelsOf({{"X", 1.0, {}}}), Error);
}

TEST(ModelLevels, OfAPieceAreThoseOfItsKind)
{
  SurfaceModel model;
  model.surfaceIds = {1, 0};
  ModelLevels levels;
  levels.ofSurface = {5, 6};
  levels.ofFeatureEdge = {7, 8};
  levels.ofCorner = {9, 10};
  EXPECT_EQ(levels.of({ModelItem::triangle, 0}, model), 6);
  EXPECT_EQ(levels.of({ModelItem::featureEdge, 1}, model), 8);
  EXPECT_EQ(levels.of({ModelItem::corner, 1}, model), 10);
}

TEST(SizedNames, AreThoseOfRulesForSurfacesAndDistances)
{
  const std::vector<std::string> names{"Roof", "Wall", "Window"};
  SizingOptions options;
  options.boxes = {{{}, 1.0}};
  EXPECT_THAT(surfacesOfRules(names, options), ElementsAre(0, 0, 0));
  options.surfaceSizes = {{"Roof", 1.0, {}}};
  options.distanceSizes = {{"Win*", 1.0, 1.0}, {"?oof", 1.0, 1.0}};
  EXPECT_THAT(surfacesOfRules(names, options), ElementsAre(1, 0, 1));
  EXPECT_THAT(sizedSurfaces("W*", names), ElementsAre(0, 1, 1));
  options.distanceSizes = {{"Door", 1.0, 1.0}};
  EXPECT_THROW(surfacesOfRules(names, options), Error);
}

/// A rule, and the level and the box in meters that it makes finer; level 0 for none.
struct FinerCase
{
  SizingOptions options;
  int level;
  Box3 box;
};

TEST(FinerPlaces, AreBoundsOfRulesFinerThanFeatures)
{
  GridFrame frame = frameOf(6);
  frame.featureLevel = 4; // 4 m
  TriangleSurface surface;
  addSheet(surface, "Roof", Vec3(10, 10, 20), Vec3(8, 0, 0), Vec3(0, 6, 0));
  addBox(surface, "Wall", {Vec3(30, 30, 1), Vec3(40, 40, 9)});
  const Box3 roof{Vec3(10, 10, 20), Vec3(18, 16, 20)};
  const Box3 around{Vec3(7.5, 7.5, 17.5), Vec3(20.5, 18.5, 22.5)};
  const Box3 any{Vec3(1, 2, 3), Vec3(4, 5, 6)};
  const auto rules = [](const std::vector<SurfaceSize>& ofSurfaces, const std::vector<RefinementBox>& ofBoxes,
                        const std::vector<DistanceSize>& ofDistances) {
    SizingOptions options;
    options.surfaceSizes = ofSurfaces;
    options.boxes = ofBoxes;
    options.distanceSizes = ofDistances;
    return options;
  };
  for (const FinerCase& of : {FinerCase{rules({{"Roof", 2.0, {}}}, {}, {}), 5, roof},
                              {rules({{"Roof", 8.0, 1.0}}, {}, {}), 6, roof},
                              {rules({{"Roof", 2.0, 8.0}}, {}, {}), 5, roof},
                              {rules({{"Roof", 4.0, {}}}, {}, {}), 0, {}},
                              {rules({}, {{any, 1.0}}, {}), 6, any},
                              {rules({}, {{any, 4.0}}, {}), 0, {}},
                              {rules({}, {{{}, 1.0}}, {}), 0, {}},
                              {rules({}, {}, {{"Roof", 2.5, 2.0}}), 5, around},
                              {rules({}, {}, {{"Roof", 2.5, 4.0}}), 0, {}}})
  {
    const std::vector<FinerPlace> places = finerPlaces(surface, frame, of.options);
    ASSERT_EQ(places.size(), of.level > 0 ? 1U : 0U);
    if (of.level > 0)
    {
      EXPECT_EQ(places[0].level, of.level);
      EXPECT_EQ(places[0].box.low, frame.toLattice(of.box.min));
      EXPECT_EQ(places[0].box.high, frame.toLattice(of.box.max));
    }
  }
}

} // namespace
