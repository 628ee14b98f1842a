// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts that size octants: rules, steps under a limit, sets of octants, samples, gaps and blocks.
#include "Octree/Sizing/ElementBudget.h"
#include "Octree/Sizing/GapSizing.h"
#include "Octree/Sizing/OctantSample.h"
#include "Octree/Sizing/OctantSets.h"
#include "Octree/Tree/OctreeBlocks.h"
#include "SizedOctree.h"
#include "Support/Error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A root of 2^depth octants of 1 m, whose domain starts and ends half an octant inside of it.
GridFrame frameOf(int depth)
{
  GridFrame frame;
  frame.depth = frame.midLevel = frame.topLevel = frame.featureLevel = depth;
  frame.origin = Vec3::Constant(-0.5);
  frame.domain = {Vec3::Zero(), Vec3::Constant(std::ldexp(1.0, depth) - 1.0)};
  fitLattice(frame, {});
  return frame;
}

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

constexpr std::array<OctantNeed, needCount> needs{OctantNeed::open, OctantNeed::region, OctantNeed::surface,
                                                  OctantNeed::feature};

TEST(KeptSizes, KeepTheStartLevelAndEachNeedDownToItsOwn)
{
  const KeptSizes sizes{{3, 1, 4, 5}, 2, 2};
  for (int level = 0; level < 7; ++level)
  {
    for (std::size_t need = 0; need < needCount; ++need)
    {
      EXPECT_EQ(sizes.keeps(level, needs.at(need)), level < std::max(2, sizes.levels.at(need))) << level;
    }
  }
}

TEST(RequestedSizes, AreThoseOfTheFrameAndTheFinestRules)
{
  GridFrame frame = frameOf(6); // 64 m at level 0
  frame.startLevel = 2;
  frame.topLevel = 3;
  ModelLevels levels;
  levels.ofSurface = {1, 4, 0};
  levels.featureOfSurface = {5, 4, 0};
  SizingOptions options;
  options.cellsPerLevel = 7;
  const auto levelsOf = [&] { return requestedSizes(frame, levels, options).levels; };
  EXPECT_THAT(levelsOf(), ElementsAre(3, 0, 4, 5));
  EXPECT_EQ(requestedSizes(frame, levels, options).startLevel, 2);
  EXPECT_EQ(requestedSizes(frame, levels, options).cellsPerLevel, 7);
  frame.topLevel = 1;
  EXPECT_THAT(levelsOf(), ElementsAre(2, 0, 4, 5)) << "the start level holds in the open";
  options.boxes = {{{}, 8.0}, {{}, 16.0}};
  EXPECT_THAT(levelsOf(), ElementsAre(2, 3, 4, 5));
  options.distanceSizes = {{"A", 1.0, 1.0}, {"A", 1.0, 2.0}};
  EXPECT_THAT(levelsOf(), ElementsAre(2, 6, 6, 5)) << "regions are at surfaces, too";
  options.boxes.clear();
  options.distanceSizes.clear();
  options.curvatureAngle = 10.0;
  EXPECT_THAT(levelsOf(), ElementsAre(2, 0, 5, 5));
  options.curvatureAngle = 0.0;
  options.cellsAcrossGap = 1;
  EXPECT_THAT(levelsOf(), ElementsAre(2, 5, 5, 5));
}

/// Levels of all needs, then the layers.
using State = std::array<int, needCount + 1>;

State stateOf(const SizeSteps& steps)
{
  const KeptSizes& kept = steps.kept();
  return {kept.levels[0], kept.levels[1], kept.levels[2], kept.levels[3], kept.cellsPerLevel};
}

/// The states of all steps where octants of all needs exist down to what is kept.
std::vector<State> allSteps(const GridFrame& frame, const KeptSizes& requested, bool withGrowth)
{
  SizeSteps steps(frame, requested);
  std::vector<State> states;
  EXPECT_FALSE(steps.isReduced());
  while (steps.giveUpMore(steps.kept().levels, withGrowth) && states.size() < 99)
  {
    EXPECT_TRUE(steps.isReduced());
    states.push_back(stateOf(steps));
  }
  return states;
}

TEST(SizeSteps, GiveUpOneLevelOrLayerAtATimeInTheirOrder)
{
  GridFrame frame = frameOf(6);
  frame.startLevel = 2;
  const KeptSizes requested{{4, 3, 4, 5}, 3, 2};
  EXPECT_THAT(allSteps(frame, requested, true),
              ElementsAre(State{3, 3, 4, 5, 3}, State{2, 3, 4, 5, 3}, State{2, 3, 4, 5, 2}, State{2, 3, 4, 5, 1},
                          State{2, 2, 4, 5, 1}, State{2, 2, 3, 5, 1}, State{2, 2, 2, 5, 1}, State{2, 2, 2, 4, 1},
                          State{2, 2, 2, 3, 1}, State{2, 2, 2, 2, 1}));
  EXPECT_THAT(allSteps(frame, requested, false),
              ElementsAre(State{3, 3, 4, 5, 3}, State{2, 3, 4, 5, 3}, State{2, 2, 4, 5, 1}, State{2, 2, 3, 5, 1},
                          State{2, 2, 2, 5, 1}, State{2, 2, 2, 4, 1}, State{2, 2, 2, 3, 1}, State{2, 2, 2, 2, 1}));
}

TEST(SizeSteps, KeepTheFacesOfNarrowSidesUntilTheEnd)
{
  GridFrame frame = frameOf(6);
  frame.startLevel = 1;
  // Each side is 8 m times the diagonal of a square: octants of 8 m, of level 3, have faces on it.
  frame.turnedDomain = PlacedPrism(Placement(), {Vec2(8, 0), Vec2(0, 8), Vec2(-8, 0), Vec2(0, -8)}, 0.0, 9.0);
  EXPECT_THAT(allSteps(frame, {{4, 1, 1, 2}, 1, 1}, true),
              ElementsAre(State{3, 1, 1, 2, 1}, State{3, 1, 1, 1, 1}, State{2, 1, 1, 1, 1}, State{1, 1, 1, 1, 1}));
  EXPECT_THAT(allSteps(frame, {{2, 1, 1, 2}, 1, 1}, true), ElementsAre(State{2, 1, 1, 1, 1}, State{1, 1, 1, 1, 1}))
      << "the requested level, where that is coarser";
}

TEST(SizeSteps, GoBelowTheOctantsThatExist)
{
  GridFrame frame = frameOf(6);
  frame.startLevel = 1;
  SizeSteps steps(frame, {{6, 6, 6, 6}, 1, 1});
  EXPECT_TRUE(steps.giveUpMore({3, 4, 5, 6}, true));
  EXPECT_EQ(stateOf(steps), (State{2, 6, 6, 6, 1}));
  EXPECT_TRUE(steps.giveUpMore({1, 4, 5, 6}, true)) << "none are left in the open";
  EXPECT_EQ(stateOf(steps), (State{1, 3, 6, 6, 1}));
  EXPECT_TRUE(steps.giveUpMore({1, 1, 5, 6}, true));
  EXPECT_EQ(stateOf(steps), (State{1, 1, 4, 6, 1}));
  EXPECT_TRUE(steps.giveUpMore({1, 1, 0, 2}, true));
  EXPECT_EQ(stateOf(steps), (State{1, 1, 1, 1, 1}));
  EXPECT_FALSE(steps.giveUpMore({1, 1, 1, 1}, true));
}

TEST(SizeSteps, NameWhatIsKeptInsteadOfWhatWasAsked)
{
  GridFrame frame = frameOf(6); // 64 m at level 0 to 1 m at level 6
  frame.startLevel = 2;
  frame.midLevel = 4;
  frame.featureLevel = 5;
  SizingOptions options;
  const std::string features = "feature curves, corners and close surfaces ";
  const auto textAfter = [&](int count) {
    SizeSteps steps(frame, {{4, 3, 4, 5}, 2, 2});
    for (int i = 0; i < count; ++i)
    {
      EXPECT_TRUE(steps.giveUpMore(steps.kept().levels, true));
    }
    return steps.text(frame, options);
  };
  EXPECT_EQ(textAfter(1), "SizeMax 8 instead of 4; surfaces, " + features + "have the sizes requested");
  EXPECT_EQ(textAfter(3), "SizeMax 16 instead of 4, CellsPerLevel 1 instead of 2; surfaces, " + features +
                              "have the sizes requested");
  EXPECT_EQ(textAfter(4), textAfter(3)) << "there are no regions";
  EXPECT_THAT(textAfter(5), HasSubstr("2, SizeMid 8 instead of 4; " + features));
  EXPECT_THAT(textAfter(7), HasSubstr(features + "no finer than 4 instead of 2 (SizeMin)"));
  options.boxes = {{{}, 8.0}};
  EXPECT_THAT(textAfter(4), HasSubstr(", RefinementBoxes no finer than 16 instead of 8 away from surfaces;"));
  options.cellsAcrossGap = 2;
  EXPECT_THAT(textAfter(4), HasSubstr("RefinementBoxes and CellsAcrossGap no finer"));
  options.distanceSizes = {{"A", 1.0, 8.0}};
  EXPECT_THAT(textAfter(4), HasSubstr("RefinementBoxes, DistanceSizeRules and CellsAcrossGap no finer"));
  options.surfaceSizes = {{"A", 4.0, {}}};
  EXPECT_THAT(textAfter(5), HasSubstr("surfaces away from feature curves, corners and close surfaces no finer than 8"));
}

/// Octants added one list after the other.
struct Added
{
  int level;
  std::vector<MortonKey> keys;
  OctantNeed need;
};

/// What is left of added octants under a limit.
struct Left
{
  RefinedSets refined;
  std::string warning;
};

Left addAll(const GridFrame& frame, const std::vector<Added>& lists, std::size_t limit)
{
  const SurfaceModel model;
  SizingOptions options;
  options.maxElements = limit;
  ElementBudget budget(model, frame, options);
  OctantSets sets(frame, {{4, 4, 4, 4}, 1, frame.startLevel}, options, budget);
  EXPECT_EQ(sets.isLimited(), limit > 0);
  for (const Added& added : lists)
  {
    sets.add(added.level, added.keys, std::vector<OctantNeed>(added.keys.size(), added.need), quietContext());
  }
  Left left;
  left.refined = sets.balanced(quietContext());
  while (left.refined.back().empty())
  {
    left.refined.pop_back();
  }
  left.warning = sets.warning();
  return left;
}

std::size_t elementsOf(const RefinedSets& refined, const GridFrame& frame)
{
  return countElements(refined, frame, quietContext());
}

const Added root{0, {0}, OctantNeed::open};
const std::vector<MortonKey> allEight{0, 1, 2, 3, 4, 5, 6, 7};

TEST(OctantSets, AreTheUnionOfWhatSourcesAdd)
{
  const GridFrame frame = frameOf(4);
  for (unsigned one = 0; one < 256; one += 3)
  {
    const unsigned other = (one * 77 + 13) % 256;
    const auto keysOf = [](unsigned bits) {
      std::vector<MortonKey> keys;
      std::ranges::copy_if(allEight, std::back_inserter(keys), [&](MortonKey key) { return (bits >> key & 1) != 0; });
      return keys;
    };
    const Left left =
        addAll(frame, {root, {1, keysOf(one), OctantNeed::region}, root, {1, keysOf(other), OctantNeed::surface}}, 0);
    const std::vector<MortonKey> both = keysOf(one | other);
    ASSERT_EQ(left.refined.size(), both.empty() ? 1U : 2U);
    EXPECT_EQ(left.refined.back(), both.empty() ? root.keys : both);
    EXPECT_EQ(left.warning, "");
  }
}

TEST(OctantSets, GiveUpTheWeakestNeedInAnyOrderAndKeepToTheLimit)
{
  GridFrame frame = frameOf(4);
  frame.startLevel = 1;
  const RefinedSets wanted{{0}, {1, 4, 6}};
  const std::size_t limit = elementsOf(wanted, frame);
  const Added open{1, allEight, OctantNeed::open};
  const Added strong{1, wanted[1], OctantNeed::surface};
  for (const std::vector<Added>& lists : {std::vector<Added>{root, open, strong}, {root, strong, open}})
  {
    const Left left = addAll(frame, lists, limit);
    EXPECT_EQ(left.refined, wanted);
    EXPECT_THAT(left.warning, HasSubstr("MaxElements " + std::to_string(limit)));
    EXPECT_THAT(left.warning, HasSubstr("up to " + std::to_string(limit) + " elements"));
    EXPECT_EQ(addAll(frame, lists, limit - 1).refined, RefinedSets{{0}});
    const std::size_t all = elementsOf({{0}, allEight}, frame);
    EXPECT_EQ(addAll(frame, lists, all).refined, (RefinedSets{{0}, allEight}));
    EXPECT_EQ(addAll(frame, lists, all).warning, "");
    EXPECT_EQ(addAll(frame, lists, all - 1).refined, wanted);
  }
}

TEST(OctantSets, LeaveOutChildrenOfWhatTheyLeaveOut)
{
  GridFrame frame = frameOf(4);
  frame.startLevel = 1;
  const RefinedSets wanted{{0}, {7}, {63}};
  const Left left = addAll(frame,
                           {root,
                            {1, {0}, OctantNeed::open},
                            {2, {0}, OctantNeed::feature},
                            {1, {7}, OctantNeed::surface},
                            {2, {63}, OctantNeed::feature}},
                           elementsOf(wanted, frame));
  EXPECT_EQ(left.refined, wanted);
}

TEST(OctantSets, AreRefusedWhereTheStartLevelIsTooMuch)
{
  std::vector<MortonKey> keys(64);
  std::iota(keys.begin(), keys.end(), MortonKey{0});
  const std::vector<Added> lists{root, {1, allEight, OctantNeed::open}, {2, keys, OctantNeed::open}};
  for (const auto& [level, reason] : std::map<int, std::string>{{2, "the domain's shortest side"}, {3, "StartLevel"}})
  {
    GridFrame frame = frameOf(4);
    frame.startLevel = level;
    RefinedSets wanted{{0}, allEight, keys};
    wanted.resize(static_cast<std::size_t>(level));
    const std::size_t least = elementsOf(wanted, frame);
    EXPECT_EQ(addAll(frame, lists, least).refined, wanted);
    try
    {
      addAll(frame, lists, least - 1);
      FAIL() << "not refused";
    }
    catch (const Error& error)
    {
      const std::string limit = "MaxElements " + std::to_string(least - 1);
      EXPECT_THAT(error.what(), HasSubstr(reason + " asks for, make more than " + limit));
    }
  }
}

TEST(OctantCounts, AddUpToLeaves)
{
  const OctantCounts counts{{1, 4, 2}, {8, 30, 16}};
  const std::array<double, 6> leaves{0, 4, 28, 16, 0, 0};
  double sum = 0.0;
  for (std::size_t level = 0; level < leaves.size(); ++level)
  {
    EXPECT_EQ(counts.leavesAt(level), leaves.at(level)) << level;
    sum += leaves.at(level);
  }
  EXPECT_EQ(counts.leaves(), sum);
  const std::array<double, 5> downTo{1, 8, 34, 48, 48};
  for (std::size_t depth = 0; depth < downTo.size(); ++depth)
  {
    EXPECT_EQ(counts.leavesDownTo(depth), downTo.at(depth)) << depth;
  }
  EXPECT_EQ(OctantCounts{}.leavesAt(0), 1.0);
  EXPECT_EQ(OctantCounts{}.leavesAt(1), 0.0);
  EXPECT_EQ(OctantCounts{}.leaves(), 1.0);
  EXPECT_EQ((OctantCounts{{1, 9}, {8, 0}}.leavesAt(1)), 0.0) << "never negative";
}

/// Octants of one size throughout, and a box that lies on none of their planes.
struct SampleCase
{
  explicit SampleCase(double length, double boxSize = 0.0)
  {
    TriangleSurface surface;
    addBox(surface, "Box", {Vec3(1, 1, 1), Vec3(2, 2, 2)});
    GridOptions grid = gridOf(length, 1.0, 1.0, 1.0);
    grid.domain.max[2] = 0.3 * length;
    if (boxSize > 0.0)
    {
      sizing.boxes = {{box, boxSize}};
    }
    of = sized(surface, grid, sizing);
    counts = sampleOctants(of.model, of.frame, sizing, quietContext());
  }

  const Box3 box{Vec3(-3.3, -5.2, -4.1), Vec3(2.7, 3.9, 0.3)};
  SizingOptions sizing;
  Sized of;
  OctantCounts counts;
};

TEST(OctantSample, IsExactForFewOctants)
{
  const SampleCase test(22.0);
  ASSERT_EQ(test.counts.refined.size(), test.of.octants.refined.size());
  std::size_t leaves = 0;
  eachLeaf(test.of.octree, [&](Index) { ++leaves; });
  EXPECT_EQ(test.counts.leaves(), static_cast<double>(leaves));
  for (std::size_t level = 0; level < test.counts.refined.size(); ++level)
  {
    EXPECT_EQ(test.counts.refined[level], static_cast<double>(test.of.octants.refined[level].size())) << level;
  }
}

TEST(OctantSample, TakesTheLargerOfTwoSources)
{
  const SampleCase test(22.0, 0.5);
  const GridFrame& frame = test.of.frame;
  std::size_t inBox = 0;
  const auto level = static_cast<int>(test.counts.refined.size()) - 1;
  EXPECT_EQ(frame.sizeOf(level), 1.0);
  for (MortonKey key = 0; key < MortonKey{1} << 3 * level; ++key)
  {
    const GridCell cell = gridCell(key);
    const Vec3 low = frame.origin + Vec3(cell[0], cell[1], cell[2]);
    const Vec3 high = low + Vec3::Constant(1.0);
    inBox += (low.array() < test.box.max.array()).all() && (high.array() > test.box.min.array()).all() ? 1 : 0;
  }
  EXPECT_EQ(test.counts.refined.back(), static_cast<double>(inBox));
  EXPECT_EQ(test.counts.children.back(), 8.0 * static_cast<double>(inBox)) << "all are in the domain";
  const SampleCase without(22.0);
  for (std::size_t l = 0; l < without.counts.refined.size(); ++l)
  {
    EXPECT_EQ(test.counts.refined[l], without.counts.refined[l]) << "the open is the larger one above";
  }
}

TEST(OctantSample, IsNearTheTruthForMany)
{
  const SampleCase test(110.0);
  ASSERT_GT(test.of.octants.refined.back().size(), 16384U) << "some are left out";
  double leaves = 0.0;
  eachLeaf(test.of.octree, [&](Index) { leaves += 1.0; });
  EXPECT_NEAR(test.counts.leaves() / leaves, 1.0, 0.03);
}

/// A sheet of 2 m x 2 m at a height, a wide one above, and gaps from the lower one.
class TwoSheets
{
public:
  TwoSheets(double width, int across, double slope = 0.0, std::vector<SurfaceSize> rules = {})
  {
    addSheet(surface, "Lower", Vec3(-1, -1, -2), Vec3(2, 0, 0), Vec3(0, 2, 0));
    addSheet(surface, "Upper", Vec3(-6, -6, width - 2 - 6 * slope), Vec3(12, 0, 12 * slope), Vec3(0, 12, 0));
    cellsAcross = across;
    sizing.surfaceSizes = std::move(rules);
  }

  TriangleSurface surface;

  /// Finds the gaps at the triangles of the lower sheet in the part of the domain with x up to `most`.
  void find(double most = 8.0, ModelItem::Kind kind = ModelItem::triangle)
  {
    of = sized(surface, gridOf(16.0, 0.25, 1.0, 4.0), sizing);
    const ModelLevels levels = modelLevels(of.model, of.frame, sizing);
    std::vector<ModelItem> pieces;
    for (Index t = 0; t < of.model.triangles.size(); ++t)
    {
      if (of.model.surfaceIds[t] == 0)
      {
        pieces.push_back({kind, t});
      }
    }
    const LatticeBox box{of.frame.toLattice(Vec3::Constant(-8)), of.frame.toLattice(Vec3(most, 8, 8))};
    lines = {GapLine{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 99}};
    level = GapSizer(of.model, of.frame, levels, cellsAcross).find(box, pieces, lines);
    lines.erase(lines.begin());
  }

  double sizeFound()
  {
    find();
    return lines.empty() ? 0.0 : of.frame.sizeOf(level);
  }
  Vec3 place(const Vec3& lattice) const { return of.frame.toModel(lattice); }

  Sized of;
  std::vector<GapLine> lines;
  int level = 0;

private:
  int cellsAcross = 1;
  SizingOptions sizing;
};

TEST(GapSizer, FitsOctantsAcrossAGapButNoFinerThanFeatures)
{
  EXPECT_EQ(TwoSheets(4.0, 4).sizeFound(), 1.0);
  EXPECT_EQ(TwoSheets(-4.0, 4).sizeFound(), 1.0) << "behind it as well";
  EXPECT_EQ(TwoSheets(3.9, 4).sizeFound(), 0.5);
  EXPECT_EQ(TwoSheets(2.0, 4).sizeFound(), 0.5);
  EXPECT_EQ(TwoSheets(2.0, 1).sizeFound(), 2.0);
  EXPECT_EQ(TwoSheets(2.0, 8).sizeFound(), 0.25);
  EXPECT_EQ(TwoSheets(0.5, 4).sizeFound(), 0.25) << "as fine as features are";
  EXPECT_EQ(TwoSheets(7.9, 2).sizeFound(), 2.0);
  EXPECT_EQ(TwoSheets(8.1, 2).sizeFound(), 0.0) << "octants in the open are fine enough";
  EXPECT_EQ(TwoSheets(0.5, 4, 0.0, {{"Upper", 0.5, 0.125}}).sizeFound(), 0.125) << "of the finer surface";
  EXPECT_EQ(TwoSheets(0.5, 4, 0.0, {{"Lower", 0.5, 0.125}}).sizeFound(), 0.125);
  EXPECT_EQ(TwoSheets(0.5, 4, 0.0, {{"Upper", 2.0, 2.0}}).sizeFound(), 0.25);
}

TEST(GapSizer, LinesLeadAcrossTheGap)
{
  TwoSheets sheets(3.0, 4);
  sheets.find();
  ASSERT_EQ(sheets.lines.size(), 2U) << "one for each triangle, on its one side";
  const double unit = sheets.of.frame.latticeUnit();
  for (const GapLine& line : sheets.lines)
  {
    EXPECT_NEAR((sheets.place(line.from) - Vec3(0, 0, -2 + 3e-3)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((sheets.place(line.to) - Vec3(0, 0, 1 - 3e-3)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((line.half * unit - 0.999 * Vec3(1, 1, 0)).norm(), 0.0, 1e-6);
    EXPECT_EQ(line.level, sheets.level);
  }
}

TEST(GapSizer, LooksFromTheOctantsPartOfATriangle)
{
  TwoSheets sheets(3.0, 4);
  sheets.find(0.0);
  ASSERT_EQ(sheets.lines.size(), 2U);
  // Triangles of (-1, -1), (1, -1), (1, 1) and (-1, -1), (1, 1), (-1, 1), up to x = 0.
  const std::array<Vec2, 2> middles{Vec2(-0.5, -0.5), Vec2(-0.5, 0.0)};
  const std::array<Vec2, 2> halves{Vec2(0.5, 0.5), Vec2(0.5, 1.0)};
  for (std::size_t i = 0; i < 2; ++i)
  {
    EXPECT_NEAR((sheets.place(sheets.lines[i].from).head<2>() - middles.at(i)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((sheets.lines[i].half.head<2>() * sheets.of.frame.latticeUnit() - 0.999 * halves.at(i)).norm(), 0.0,
                1e-6);
  }
  sheets.find(-1.1);
  EXPECT_THAT(sheets.lines, IsEmpty());
  EXPECT_EQ(sheets.level, 0);
  sheets.find(8.0, ModelItem::featureEdge);
  EXPECT_THAT(sheets.lines, IsEmpty());
}

TEST(GapSizer, TakesTheFirstTriangleIfItFacesTheRay)
{
  EXPECT_GT(TwoSheets(3.0, 4, std::tan(28.0 * std::numbers::pi / 180.0)).sizeFound(), 0.0);
  EXPECT_EQ(TwoSheets(3.0, 4, std::tan(32.0 * std::numbers::pi / 180.0)).sizeFound(), 0.0);
  TwoSheets hidden(6.0, 4);
  EXPECT_GT(hidden.sizeFound(), 0.0);
  addSheet(hidden.surface, "Slanted", Vec3(-3, -3, -3.5), Vec3(6, 0, 6), Vec3(0, 6, 0));
  EXPECT_EQ(hidden.sizeFound(), 0.0);
}

RefinedSets randomSets(unsigned seed, int depth)
{
  std::mt19937 random(seed);
  RefinedSets refined{{0}};
  while (static_cast<int>(refined.size()) < depth && !refined.back().empty())
  {
    std::vector<MortonKey> next;
    for (const MortonKey parent : refined.back())
    {
      for (MortonKey k = 0; k < 8; ++k)
      {
        if (random() % 10 < 3)
        {
          next.push_back(parent << 3 | k);
        }
      }
    }
    refined.push_back(next);
  }
  return refined;
}

bool isRefined(const RefinedSets& refined, int level, MortonKey key)
{
  return level < static_cast<int>(refined.size()) &&
         std::ranges::count(refined[static_cast<std::size_t>(level)], key) > 0;
}

std::size_t leavesOf(const RefinedSets& refined, int level, MortonKey key)
{
  if (!isRefined(refined, level, key))
  {
    return 1;
  }
  std::size_t leaves = 0;
  for (MortonKey k = 0; k < 8; ++k)
  {
    leaves += leavesOf(refined, level + 1, key << 3 | k);
  }
  return leaves;
}

/// The blocks of an octree, looked at octant by octant.
class BlockCheck
{
public:
  BlockCheck(const RefinedSets& sets, int levels, std::size_t limit, const OctreeBlocks& found)
      : refined(sets), depth(levels), most(limit), blocks(found)
  {
  }

  void run()
  {
    const std::size_t covered = check(0, 0);
    EXPECT_EQ(covered, blocks.count());
  }

private:
  /// Ancestors that begin where an octant does count as its own.
  std::size_t slack() const { return 7 * static_cast<std::size_t>(depth); }

  bool isBegin(MortonKey key) const { return std::ranges::binary_search(blocks.begins, key); }

  /// Checks the blocks that begin in an octant. Returns the number of these.
  std::size_t check(int level, MortonKey key)
  {
    const MortonKey begin = key << 3 * (depth - level);
    const MortonKey end = (key + 1) << 3 * (depth - level);
    const auto first = std::ranges::lower_bound(blocks.begins, begin) - blocks.begins.begin();
    const auto last = std::ranges::lower_bound(blocks.begins, end) - blocks.begins.begin();
    if (last - first <= 1)
    {
      return static_cast<std::size_t>(last - first); // a block, or part of one that began before
    }
    EXPECT_TRUE(isRefined(refined, level, key)) << "leaves are not divided";
    EXPECT_TRUE(isBegin(begin) && isBegin(end)) << "what is divided has blocks of its own";
    EXPECT_GT(leavesOf(refined, level, key) + slack(), most) << "divided without need";
    std::size_t count = 0;
    for (MortonKey k = 0; k < 8; ++k)
    {
      count += check(level + 1, key << 3 | k);
    }
    checkMerged(level, key);
    return count;
  }

  /// Checks blocks of whole children: two in a row would be too large together.
  void checkMerged(int level, MortonKey key)
  {
    const int shift = 3 * (depth - level - 1);
    const auto isChild = [&](std::size_t b) {
      const MortonKey begin = blocks.begins[b];
      const MortonKey end = blocks.begins[b + 1];
      return begin >> shift << shift == begin && end >> shift << shift == end;
    };
    const auto first =
        static_cast<std::size_t>(std::ranges::lower_bound(blocks.begins, key << (shift + 3)) - blocks.begins.begin());
    for (std::size_t b = first; blocks.begins[b + 1] < (key + 1) << (shift + 3); ++b)
    {
      EXPECT_TRUE(!isChild(b) || !isChild(b + 1) || blocks.leaves[b] + blocks.leaves[b + 1] > most);
    }
  }

  const RefinedSets& refined;
  int depth;
  std::size_t most;
  const OctreeBlocks& blocks;
};

/// Leaves of each block, counted one by one.
std::vector<std::size_t> countLeaves(const Octree& octree, const OctreeBlocks& blocks)
{
  std::vector<std::size_t> counts(blocks.count(), 0);
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    ++counts[blocks.blockOf(octree.finestKey(leaf))];
  }
  return counts;
}

TEST(OctreeBlocks, AreOctantsWithNeighborsMergedWhileTheyFit)
{
  constexpr int depth = 4;
  const GridFrame frame = frameOf(depth);
  for (unsigned seed = 1; seed <= 30; ++seed)
  {
    const RefinedSets refined = randomSets(seed, depth);
    const Octree octree(frame, refined);
    const std::size_t all = octree.leafCount();
    for (const std::size_t most : {std::size_t{1}, std::size_t{2}, std::size_t{8}, std::size_t{20}, all - 1, all})
    {
      SCOPED_TRACE(std::to_string(seed) + ", at most " + std::to_string(most));
      const OctreeBlocks found = findBlocks(refined, frame, most);
      ASSERT_EQ(found.begins.size(), found.count() + 1);
      EXPECT_EQ(found.begins.front(), 0U);
      EXPECT_EQ(found.begins.back(), MortonKey{1} << 3 * depth);
      EXPECT_EQ(found.count() == 1, most >= all);
      const std::vector<std::size_t> leaves = countLeaves(octree, found);
      for (std::size_t b = 0; b < found.count(); ++b)
      {
        EXPECT_LE(leaves[b], most);
        EXPECT_GE(found.leaves[b], leaves[b]);
        EXPECT_LE(found.leaves[b], leaves[b] + std::size_t{7 * depth});
      }
      BlockCheck(refined, depth, most, found).run();
    }
  }
  EXPECT_EQ(findBlocks({}, frame, 5).begins, (std::vector<MortonKey>{0, MortonKey{1} << 3 * depth}));
}

TEST(OctreeBlocks, AreFoundByKey)
{
  const OctreeBlocks blocks{{0, 8, 16, 64}, {1, 1, 1}};
  for (const auto& [key, block] : std::map<MortonKey, Index>{{0, 0}, {7, 0}, {8, 1}, {15, 1}, {16, 2}, {63, 2}})
  {
    EXPECT_EQ(blocks.blockOf(key), block) << key;
  }
}

struct Division
{
  std::vector<std::size_t> costs;
  std::size_t ranks;
  std::vector<Index> firsts;
};

TEST(OctreeBlocks, AreDividedByTheMiddlesOfTheirCosts)
{
  for (const Division& of : {Division{{1, 1, 1, 1}, 2, {0, 2, 4}},
                             {{1, 1, 1, 1}, 1, {0, 4}},
                             {{1, 1, 1, 1}, 4, {0, 1, 2, 3, 4}},
                             {{3, 1, 1, 1}, 2, {0, 1, 4}},
                             {{1, 1, 1, 3}, 2, {0, 3, 4}},
                             {{2, 2, 2}, 2, {0, 2, 3}},
                             {{100, 1, 1}, 3, {0, 1, 2, 3}},
                             {{1, 1, 100}, 3, {0, 1, 2, 3}},
                             {{1, 1, 1, 1, 100}, 3, {0, 3, 4, 5}},
                             {{0, 0, 0}, 2, {0, 2, 3}},
                             {{1, 1}, 3, {0, 1, 1, 2}},
                             {{5}, 2, {0, 1, 1}},
                             {{}, 2, {0, 0, 0}}})
  {
    EXPECT_EQ(divideBlocks(of.costs, of.ranks), of.firsts) << of.costs.size() << " among " << of.ranks;
  }
}

TEST(OctreeBlocks, OfEqualCostAreDividedEqually)
{
  for (std::size_t ranks = 1; ranks <= 9; ++ranks)
  {
    for (std::size_t count = ranks; count <= 4 * ranks; ++count)
    {
      const std::vector<Index> firsts = divideBlocks(std::vector<std::size_t>(count, 7), ranks);
      ASSERT_EQ(firsts.size(), ranks + 1);
      EXPECT_EQ(firsts.back(), count);
      for (std::size_t rank = 0; rank < ranks; ++rank)
      {
        const std::size_t own = firsts[rank + 1] - firsts[rank];
        EXPECT_TRUE(own == count / ranks || own == (count + ranks - 1) / ranks) << count << " among " << ranks;
      }
    }
  }
}

} // namespace
