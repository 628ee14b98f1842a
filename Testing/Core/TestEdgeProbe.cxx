// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests cuts of grid edges with triangles, and which of them an edge keeps.
#include "Dual/Grid/EdgeProbe.h"
#include "GridSamples.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

EdgeSegment segmentOf(const LatticePoint& start, const LatticePoint& end, int axis, std::int64_t size = 0)
{
  return {start, end, axis, size, {0, 0, 0, 0}};
}

/// The cut of a line with a triangle in floating point; `isSure` is false close to borders.
struct PlainCut
{
  PlainCut(const LatticePoint& start, const LatticePoint& end, const std::array<LatticePoint, 3>& corners)
  {
    const Vec3 p = toVector(start);
    const Vec3 along = toVector(end) - p;
    const std::array<Vec3, 3> t{toVector(corners[0]), toVector(corners[1]), toVector(corners[2])};
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const double slope = normal.dot(along);
    isSure = std::abs(slope) > 1e-6 * normal.norm() * along.norm();
    parameter = isSure ? normal.dot(t[0] - p) / slope : 0.0;
    sense = slope > 0.0 ? 1 : -1;
    isCut = parameter > 0.0 && parameter < 1.0;
    isSure = isSure && std::abs(parameter) > 1e-9 && std::abs(parameter - 1.0) > 1e-9;
    const Vec3 at = p + parameter * along;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double side = (t.at((i + 1) % 3) - t.at(i)).cross(at - t.at(i)).dot(normal) / normal.squaredNorm();
      isCut = isCut && side > 0.0;
      isSure = isSure && std::abs(side) > 1e-9;
    }
  }

  double parameter = 0.0;
  int sense = 0;
  bool isCut = false;
  bool isSure = false;
};

TEST(Crossings, AreThoseOfLinesAndTriangles)
{
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int64_t> place(-1000, 1000);
  int cuts = 0;
  for (int round = 0; round < 20000; ++round)
  {
    const auto point = [&] { return LatticePoint{place(random), place(random), place(random)}; };
    const std::array<LatticePoint, 3> t{point(), point(), point()};
    const LatticePoint start = point();
    const int axis = round % 4 - 1;
    const LatticePoint end = axis < 0 ? point() : moved(start, 2 * axis + round / 4 % 2, 700);
    const PlainCut expected(start, end, t);
    const std::optional<SurfaceCrossing> found = crossingOf(segmentOf(start, end, axis), t[0], t[1], t[2], 17);
    if (!expected.isSure)
    {
      continue;
    }
    ASSERT_EQ(found.has_value(), expected.isCut) << round;
    if (found)
    {
      ++cuts;
      EXPECT_EQ(found->triangle, 17U);
      EXPECT_EQ(found->orientation, expected.sense);
      EXPECT_NEAR(found->parameter, expected.parameter, 1e-9);
    }
  }
  EXPECT_GT(cuts, 500);
}

/// A surface whose points are on the lattice as they are.
SurfaceModel modelOf(const TriangleSurface& surface)
{
  SurfaceModel model;
  for (const Vec3& p : surface.points)
  {
    model.points.push_back({std::llround(p[0]), std::llround(p[1]), std::llround(p[2])});
  }
  model.triangles = surface.triangles;
  model.surfaceIds = surface.surfaceIds;
  model.names = surface.names;
  model.charts.assign(surface.triangles.size(), 0);
  model.domainSides.assign(surface.triangles.size(), SurfaceModel::noSide);
  return model;
}

/// True if the point, which is thought to be shifted upwards a little, is in the box.
bool isWithin(const LatticePoint& p, std::int64_t low, std::int64_t high)
{
  return std::ranges::all_of(p, [&](std::int64_t x) { return x >= low && x < high; });
}

TEST(Crossings, OfAClosedBoxAreOneWhereAnEdgeEntersWhateverCoincides)
{
  TriangleSurface surface;
  addBox(surface, "Box", {Vec3::Constant(4), Vec3::Constant(12)});
  const SurfaceModel model = modelOf(surface);
  for (int i = 0; i < 3 * 5 * 5 * 5; ++i)
  {
    const int axis = i / 125;
    const LatticePoint start{i % 5 * 4, i / 5 % 5 * 4, i / 25 % 5 * 4};
    for (const int direction : {2 * axis, 2 * axis + 1})
    {
      const LatticePoint end = moved(start, direction, 4);
      const bool leaves = isWithin(start, 4, 12);
      const std::size_t expected = leaves != isWithin(end, 4, 12) ? 1 : 0;
      for (const int kind : {axis, -1})
      {
        std::vector<SurfaceCrossing> found;
        for (Index t = 0; t < 12; ++t)
        {
          const auto cut =
              crossingOf(segmentOf(start, end, kind), model.corner(t, 0), model.corner(t, 1), model.corner(t, 2), t);
          found.insert(found.end(), cut ? 1 : 0, cut.value_or(SurfaceCrossing{}));
        }
        ASSERT_EQ(found.size(), expected);
        if (expected > 0)
        {
          EXPECT_EQ(found[0].orientation, leaves ? 1 : -1);
          EXPECT_EQ(found[0].parameter, isUpper(direction) ? 1.0 : 0.0);
        }
      }
    }
  }
}

TEST(Crossings, AreSeenFromTheFrontThatTheNormalPointsTo)
{
  for (const std::int32_t along : {-1, 1})
  {
    const SurfaceCrossing cut{0, along, 0.5};
    EXPECT_EQ(seenFromStart(cut), along < 0 ? SheetSide::front : SheetSide::back);
    EXPECT_EQ(seenFromEnd(cut), along > 0 ? SheetSide::front : SheetSide::back);
  }
}

TEST(Segments, HaveBoundsAndPlaces)
{
  const EdgeSegment edge = segmentOf({5, -3, 8}, {1, 9, 8}, -1);
  EXPECT_EQ(boundsOf(edge).low, (LatticePoint{1, -3, 8}));
  EXPECT_EQ(boundsOf(edge).high, (LatticePoint{5, 9, 8}));
  EXPECT_EQ(pointOn(edge, 0.0), Vec3(5, -3, 8));
  EXPECT_EQ(pointOn(edge, 0.25), Vec3(4, 0, 8));
  EXPECT_EQ(pointOn(edge, 1.0), Vec3(1, 9, 8));
}

TEST(Segments, TouchTheBoundsOfTriangles)
{
  TriangleSurface surface;
  addSurface(surface, "T", {{0, 0, 0}, {10, 0, 0}, {0, 10, 4}}, {{0, 1, 2}});
  const SurfaceModel model = modelOf(surface);
  EXPECT_TRUE(touchesBounds({{10, 10, 4}, {20, 20, 20}}, model, 0)) << "a common corner is enough";
  EXPECT_FALSE(touchesBounds({{11, 0, 0}, {20, 20, 20}}, model, 0));
  EXPECT_FALSE(touchesBounds({{0, 11, 0}, {20, 20, 20}}, model, 0));
  EXPECT_FALSE(touchesBounds({{-9, -9, -9}, {20, 20, -1}}, model, 0));
}

/// A model in the one leaf of an octree.
class OneLeaf
{
public:
  explicit OneLeaf(SurfaceModel of) : model(std::move(of)), octree(frameOf(0), {})
  {
    std::vector<ModelItem> items;
    for (Index t = 0; t < model.triangles.size(); ++t)
    {
      items.push_back({ModelItem::triangle, t});
    }
    for (Index e = 0; e < model.featureEdges.size(); ++e)
    {
      items.push_back({ModelItem::featureEdge, e});
    }
    octree.setItems({0, static_cast<Index>(items.size())}, items, {FeatureType::several});
  }

  std::vector<Index> cut(const EdgeSegment& edge)
  {
    EdgeProbe probe(octree, model);
    std::vector<Index> triangles;
    const std::vector<Index> leaves{0};
    const std::span<const SurfaceCrossing> found = probe.cut(edge, leaves);
    std::ranges::transform(found, std::back_inserter(triangles), &SurfaceCrossing::triangle);
    EXPECT_TRUE(std::ranges::is_sorted(found, {}, &SurfaceCrossing::parameter));
    return triangles;
  }

  SurfaceModel model;
  Octree octree;
};

/// Two triangles that meet in a ridge along y, above the x axis at `height`; they reach x = -width and width.
void addTent(TriangleSurface& to, double width, double height)
{
  addSurface(to, "Tent", {{-width, -1000, 0}, {0, -1000, height}, {0, 1000, height}, {width, -1000, 0}},
             {{0, 1, 2}, {3, 2, 1}});
}

const EdgeSegment throughTents = segmentOf({-2000, -900, 200}, {2000, -900, 200}, 0, 1000);

SurfaceModel tentModel(double height, const std::vector<Index>& charts = {0, 0})
{
  TriangleSurface surface;
  addTent(surface, 1000, height);
  SurfaceModel model = modelOf(surface);
  model.charts = charts;
  return model;
}

TEST(EdgeProbe, DropsABulgeOfASmoothPieceAndKeepsThinWalls)
{
  EXPECT_THAT(OneLeaf(tentModel(400)).cut(throughTents), IsEmpty());
  EXPECT_THAT(OneLeaf(tentModel(1100)).cut(throughTents), ElementsAre(0, 1)) << "its sides are a wall's";
  EXPECT_THAT(OneLeaf(tentModel(400, {0, 1})).cut(throughTents), ElementsAre(0, 1)) << "they are no one piece";
  SurfaceModel turned = tentModel(400);
  std::swap(turned.triangles[1][0], turned.triangles[1][1]);
  EXPECT_THAT(OneLeaf(turned).cut(throughTents), ElementsAre(0, 1)) << "it does not face one way";
  const EdgeSegment half = segmentOf({-2000, -900, 200}, {0, -900, 200}, 0, 1000);
  EXPECT_THAT(OneLeaf(tentModel(400)).cut(half), ElementsAre(0));
}

/// A tent of two charts with a curve along its ridge.
SurfaceModel creasedTent(const std::vector<Index>& chartsOfCurve)
{
  SurfaceModel model = tentModel(400, {0, 1});
  model.featureEdges = {{1, 2, 0}};
  model.curves = {{CurveKind::crease, chartsOfCurve, chartsOfCurve}};
  return model;
}

TEST(EdgeProbe, DropsTheTipOfACreaseThatEndsCloseBeyondTheEdge)
{
  const auto cutAtSize = [](std::int64_t size, const std::vector<Index>& charts) {
    EdgeSegment edge = throughTents;
    edge.size = size;
    return OneLeaf(creasedTent(charts)).cut(edge).size();
  };
  // The ridge is 200 above the edge; a tip may reach 0.3 of the edge's length beyond it.
  const auto limit = static_cast<std::int64_t>(200.0 / nickDepth);
  EXPECT_EQ(cutAtSize(limit + 2, {0, 1}), 0U);
  EXPECT_EQ(cutAtSize(limit - 2, {0, 1}), 2U);
  EXPECT_EQ(cutAtSize(1000, {0, 1, 2}), 2U) << "three pieces meet";
  EXPECT_EQ(cutAtSize(1000, {0, 2}), 2U);
  EXPECT_EQ(cutAtSize(1000, {1, 2}), 2U);
  EXPECT_EQ(cutAtSize(1000, {0}), 2U);
}

TEST(EdgeProbe, DropsBulgesWithinBulges)
{
  TriangleSurface surface;
  addTent(surface, 1600, 420);
  addTent(surface, 1000, 300);
  SurfaceModel model = modelOf(surface);
  model.charts = {5, 5, 6, 6};
  EXPECT_THAT(OneLeaf(model).cut(throughTents), IsEmpty());
  model.charts = {5, 6, 7, 7};
  EXPECT_THAT(OneLeaf(model).cut(throughTents), ElementsAre(0, 1));
  model.charts = {5, 7, 6, 8};
  EXPECT_THAT(OneLeaf(model).cut(throughTents), ElementsAre(0, 2, 3, 1)) << "from start to end";
}

TEST(EdgeProbe, DropsBulgesOfWallsAndOfPermeableSurfacesApart)
{
  TriangleSurface surface;
  addTent(surface, 1000, 400);
  addSurface(surface, "Plane", {{0, -4000, -900}, {0, 4000, -900}, {0, 0, 900}}, {{0, 1, 2}});
  addTent(surface, 1400, 420);
  SurfaceModel model = modelOf(surface);
  model.charts = {0, 0, 1, 2, 2};
  EXPECT_THAT(OneLeaf(model).cut(throughTents), ElementsAre(3, 0, 2, 1, 4));
  model.kinds = {SurfaceKind::wall, SurfaceKind::faceZone, SurfaceKind::wall};
  EXPECT_THAT(OneLeaf(model).cut(throughTents), ElementsAre(2));
  model.kinds = {SurfaceKind::cellZone, SurfaceKind::wall, SurfaceKind::cellZone};
  EXPECT_THAT(OneLeaf(model).cut(throughTents), ElementsAre(2));
  model.kinds = {SurfaceKind::faceZone, SurfaceKind::faceZone, SurfaceKind::wall};
  EXPECT_THAT(OneLeaf(model).cut(throughTents), ElementsAre(0, 2, 1));
}

TriangleSurface manyTriangles(unsigned seed, Index count)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 1000);
  std::uniform_real_distribution<double> step(-200, 200);
  TriangleSurface surface;
  surface.names = {"All"};
  for (Index t = 0; t < count; ++t)
  {
    const Vec3 a(place(random), place(random), place(random));
    surface.points.push_back(a);
    surface.points.emplace_back(a + Vec3(step(random), step(random), step(random)));
    surface.points.emplace_back(a + Vec3(step(random), step(random), step(random)));
    surface.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    surface.surfaceIds.push_back(0);
  }
  return surface;
}

TEST(EdgeProbe, GathersTheTrianglesWhoseBoundsTouchButNoneOnSides)
{
  std::mt19937 random(2);
  for (const Index count : {20U, 64U, 65U, 200U})
  {
    SurfaceModel model = modelOf(manyTriangles(count, count));
    for (Index t = 0; t < count; t += 7)
    {
      model.domainSides[t] = zMin;
    }
    const OneLeaf of(model);
    const TriangleTreeOnDemand tree(of.model);
    for (int round = 0; round < 30; ++round)
    {
      const auto place = [&] { return static_cast<std::int64_t>(random() % 900); };
      const LatticePoint low{place(), place(), place()};
      const LatticeBox box{low, {low[0] + 100, low[1] + 50, low[2] + 20}};
      std::vector<Index> expected;
      for (Index t = 0; t < count; ++t)
      {
        const Box3 bounds = of.model.bounds(t);
        const bool isNear = bounds.touches({toVector(box.low), toVector(box.high)});
        expected.insert(expected.end(), isNear && t % 7 != 0 ? 1 : 0, t);
      }
      std::vector<Index> found{999};
      for (const std::vector<Index>& leaves : {std::vector<Index>{0}, {0, 0}})
      {
        EdgeProbe(of.octree, of.model).gather(box, leaves, found);
        EXPECT_EQ(found, expected);
        EdgeProbe(of.octree, of.model, &tree).gather(box, leaves, found);
        EXPECT_EQ(found, expected) << "with a tree";
      }
    }
  }
}

TEST(EdgeProbe, FindsTheTriangleThatCoversADomainSide)
{
  TriangleSurface surface;
  addSheet(surface, "Floor", {0, 0, 0}, {100, 0, 0}, {0, 100, 0});
  SurfaceModel model = modelOf(surface);
  model.domainSides = {zMin, zMin};
  const OneLeaf of(model);
  const EdgeProbe probe(of.octree, of.model);
  EXPECT_EQ(probe.sideTriangle(0, {70, 30, 50}, zMin), 0U);
  EXPECT_EQ(probe.sideTriangle(0, {30, 70, 50}, zMin), 1U);
  EXPECT_EQ(probe.sideTriangle(0, {30, 70, 50}, zMax), noIndex);
  EXPECT_EQ(probe.sideTriangle(0, {101, 70, 50}, zMin), noIndex);
  SurfaceModel within = model;
  within.domainSides = {SurfaceModel::noSide, zMin};
  const OneLeaf partly(within);
  EXPECT_EQ(EdgeProbe(partly.octree, partly.model).sideTriangle(0, {70, 30, 50}, zMin), noIndex);
}

} // namespace
