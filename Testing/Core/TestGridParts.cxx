// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts of the dual method below the zones: grid points, edges and their cuts, and the mesh structure.
#include "Dual/Grid/EdgeProbe.h"
#include "Dual/Grid/GridPlaces.h"
#include "Dual/Grid/JoinedPoints.h"
#include "Dual/Mesh/DualMesh.h"
#include "Dual/Mesh/FaceFlux.h"
#include "Dual/Mesh/MetSides.h"
#include "Dual/Mesh/OwnElements.h"
#include "Dual/Mesh/Sheets.h"
#include "Grid/Prism.h"
#include "Octree/Tree/Balance.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Points of a block that are joined to some of their neighbors, in rows along x; numbers start at `first`.
class RandomLinks
{
public:
  RandomLinks(std::array<Index, 3> size, Index first, unsigned seed, unsigned percent) : size_(size), first_(first)
  {
    std::mt19937 random(seed);
    open_.resize(std::size_t{3} * count());
    std::ranges::generate(open_, [&] { return random() % 100 < percent; });
  }

  Index count() const { return size_[0] * size_[1] * size_[2]; }

  /// The linked point in a direction, or noIndex; links lead both ways.
  Index nextTo(Index point, int direction) const
  {
    const Index at = point - first_;
    const auto axis = static_cast<std::size_t>(axisOf(direction));
    const std::array<Index, 3> steps{1, size_[0], size_[0] * size_[1]};
    const Index place = at / steps.at(axis) % size_.at(axis);
    if (isUpper(direction) ? place + 1 == size_.at(axis) : place == 0)
    {
      return noIndex;
    }
    const Index lower = isUpper(direction) ? at : at - steps.at(axis);
    return open_[3 * lower + axis] ? (isUpper(direction) ? point + steps.at(axis) : point - steps.at(axis)) : noIndex;
  }

  /// Sets within a range by flooding, in the order of their first points.
  std::vector<Index> setsOf(const IndexRange& own) const
  {
    std::vector<Index> sets(own.size(), noIndex);
    Index count = 0;
    for (Index seed = own.begin; seed < own.end; ++seed)
    {
      if (sets[seed - own.begin] == noIndex)
      {
        flood(own, seed, count++, sets);
      }
    }
    return sets;
  }

private:
  void flood(const IndexRange& own, Index seed, Index set, std::vector<Index>& sets) const
  {
    std::vector<Index> open{seed};
    sets[seed - own.begin] = set;
    while (!open.empty())
    {
      const Index point = open.back();
      open.pop_back();
      for (int direction = 0; direction < 6; ++direction)
      {
        const Index next = nextTo(point, direction);
        if (next != noIndex && own.contains(next) && sets[next - own.begin] == noIndex)
        {
          sets[next - own.begin] = set;
          open.push_back(next);
        }
      }
    }
  }

  std::array<Index, 3> size_;
  Index first_;
  std::vector<char> open_;
};

void expectJoined(const RandomLinks& links, const IndexRange& own, const Executor& executor)
{
  const auto nextTo = [&](Index point, int direction) { return links.nextTo(point, direction); };
  const PointSets sets = joinOwn(own, nextTo, quietContext(executor));
  const std::vector<Index> expected = links.setsOf(own);
  EXPECT_EQ(sets.ofOwn, expected);
  EXPECT_EQ(sets.count, expected.empty() ? 0U : 1U + std::ranges::max(expected));
}

TEST(JoinedPoints, AreTheSetsThatAFloodReaches)
{
  const SerialExecutor serial;
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    const Index first = 13 * (seed % 3);
    const RandomLinks links({2 + seed % 4, 1 + seed % 5, 3}, first, seed, 10 + seed % 60);
    expectJoined(links, {first, first + links.count()}, serial);
    expectJoined(links, {first + 2, first + links.count() - 3}, serial); // points of others are no part of it
    expectJoined(links, {first, first}, serial);
  }
}

TEST(JoinedPoints, AreTheSameInLargeNumbersOnSeveralThreads)
{
  const RandomLinks links({40, 40, 31}, 5, 7, 34); // more than two pieces of points, with sets across them
  const ThreadExecutor threads(3);
  const SerialExecutor serial;
  for (const Executor* executor : {static_cast<const Executor*>(&threads), static_cast<const Executor*>(&serial)})
  {
    expectJoined(links, {5, 5 + links.count()}, *executor);
  }
}

/// A root of 2^depth octants of 1 m, whose domain starts and ends half an octant inside of it.
GridFrame frameOf(int depth)
{
  GridFrame frame;
  frame.depth = depth;
  frame.origin = Vec3::Constant(-0.5);
  frame.domain = {Vec3::Zero(), Vec3::Constant(std::ldexp(1.0, depth) - 1.0)};
  fitLattice(frame, {});
  return frame;
}

/// A balanced octree of random octants, its grid points, and these by place.
class RandomGrid
{
public:
  explicit RandomGrid(unsigned seed) : octree(makeOctree(seed)), points(findGridPoints(octree, quietContext()))
  {
    for (Index point = 0; point < points.size(); ++point)
    {
      byPlace[grid.undisplaced(point)] = point;
    }
  }

  Index pointAt(const LatticePoint& place) const
  {
    const auto found = byPlace.find(place);
    return found == byPlace.end() ? noIndex : found->second;
  }

  Octree octree;
  GridPoints points;
  GridPlaces grid{octree, points};
  std::map<LatticePoint, Index> byPlace;

private:
  static Octree makeOctree(unsigned seed)
  {
    std::mt19937 random(seed);
    const GridFrame frame = frameOf(4);
    RefinedSets sets{{0}, {}, {}, {}};
    for (std::size_t level = 1; level < 4; ++level)
    {
      for (const MortonKey parent : sets[level - 1])
      {
        for (MortonKey k = 0; k < 8; ++k)
        {
          if (random() % 10 < 4)
          {
            sets[level].push_back(parent << 3 | k);
          }
        }
      }
    }
    balance(sets, frame, quietContext());
    return {frame, sets};
  }
};

LatticePoint moved(LatticePoint place, int direction, std::int64_t by)
{
  place.at(static_cast<std::size_t>(axisOf(direction))) += isUpper(direction) ? by : -by;
  return place;
}

/// Expects an edge of the finest of the four leaves in a direction if one of them has a corner at the point.
void expectEdge(const RandomGrid& of, Index point, int direction)
{
  const LatticePoint place = of.grid.undisplaced(point);
  const unsigned bit = 1U << axisOf(direction);
  bool hasCorner = false;
  int finest = 0;
  for (unsigned slot = 0; slot < 8; ++slot)
  {
    const Index leaf = of.points.leaves[point].at(slot);
    const bool isThere = ((slot & bit) != 0) == isUpper(direction);
    for (unsigned corner = 0; corner < 8 && isThere; ++corner)
    {
      hasCorner = hasCorner || of.octree.cornerOf(leaf, corner) == place;
    }
    finest = isThere ? std::max(finest, of.octree.level(leaf)) : finest;
  }
  const GridPlaces::Edge edge = of.grid.edge(point, direction);
  ASSERT_EQ(edge.exists(), hasCorner);
  if (edge.exists())
  {
    EXPECT_EQ(of.octree.level(edge.at.leaf), finest);
    EXPECT_EQ(of.octree.cornerOf(edge.at.leaf, edge.at.corner), place);
    const LatticePoint end = moved(place, direction, of.octree.frame().latticeSize(finest));
    EXPECT_EQ(of.octree.cornerOf(edge.at.leaf, edge.at.corner ^ bit), end);
    EXPECT_EQ(edge.other, of.pointAt(end));
  }
}

TEST(GridPlaces, HaveTheEdgesOfTheFinestLeaves)
{
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    const RandomGrid of(seed);
    ASSERT_GT(of.points.size(), 0U);
    for (Index point = 0; point < of.points.size(); ++point)
    {
      const std::array<GridPlaces::Edge, 6> edges = of.grid.edges(point);
      for (int direction = 0; direction < 6; ++direction)
      {
        expectEdge(of, point, direction);
        const GridPlaces::Edge one = of.grid.edge(point, direction);
        const GridPlaces::Edge& same = edges.at(static_cast<std::size_t>(direction));
        EXPECT_EQ(std::tie(same.at.leaf, same.other), std::tie(one.at.leaf, one.other));
        EXPECT_TRUE(!one.exists() || same.at.corner == one.at.corner);
      }
    }
  }
}

/// The leaves around an edge that starts at a place, looked up in the octree.
std::array<Index, 4> leavesAround(const Octree& octree, const LatticePoint& place, int direction)
{
  constexpr std::array<std::array<int, 2>, 4> upper{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const auto axis = static_cast<std::size_t>(axisOf(direction));
  std::array<Index, 4> leaves{};
  for (std::size_t i = 0; i < 4; ++i)
  {
    LatticePoint p = place;
    p.at(axis) -= isUpper(direction) ? 0 : 1;
    p.at((axis + 1) % 3) -= 1 - upper.at(i)[0];
    p.at((axis + 2) % 3) -= 1 - upper.at(i)[1];
    leaves.at(i) = octree.leafAt(p);
  }
  return leaves;
}

TEST(GridPlaces, GiveEdgesAsSegmentsThatEndOnTheDomainsSides)
{
  const RandomGrid of(6);
  const GridFrame& frame = of.octree.frame();
  int leaving = 0;
  for (Index point = 0; point < of.points.size(); ++point)
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      const GridPlaces::Edge edge = of.grid.edge(point, direction);
      if (!edge.exists())
      {
        continue;
      }
      const auto axis = static_cast<std::size_t>(axisOf(direction));
      const EdgeSegment segment = of.grid.segment(point, direction, edge);
      const LatticePoint place = of.grid.undisplaced(point);
      LatticePoint end = moved(place, direction, segment.size);
      EXPECT_EQ(edge.other == noIndex, !frame.inDomain(end));
      leaving += edge.other == noIndex ? 1 : 0;
      end.at(axis) = std::clamp(end.at(axis), frame.domainLow.at(axis), frame.domainHigh.at(axis));
      EXPECT_EQ(segment.start, place);
      EXPECT_EQ(segment.end, end);
      EXPECT_EQ(segment.axis, axisOf(direction));
      EXPECT_EQ(segment.size, frame.latticeSize(of.octree.level(edge.at.leaf)));
      EXPECT_EQ(segment.about, leavesAround(of.octree, place, direction));
    }
  }
  EXPECT_GT(leaving, 0);
}

TEST(GridPlaces, ListTheLeavesAroundBothEndsOfAnEdge)
{
  const RandomGrid of(7);
  for (Index point = 0; point < of.points.size(); ++point)
  {
    const GridPlaces::Edge edge = of.grid.edge(point, static_cast<int>(point % 6));
    std::set<Index> leaves(of.points.leaves[point].begin(), of.points.leaves[point].end());
    if (edge.other != noIndex)
    {
      leaves.insert(of.points.leaves[edge.other].begin(), of.points.leaves[edge.other].end());
    }
    EXPECT_EQ(of.grid.leavesNear(point, edge), std::vector<Index>(leaves.begin(), leaves.end()));
  }
}

TEST(GridPlaces, KeepWhatWasMovedUntilItIsMovedBack)
{
  const RandomGrid of(8);
  GridPlaces grid(of.octree, of.points);
  EXPECT_FALSE(grid.isDisplaced(3));
  EXPECT_THAT(grid.displacedPoints(), IsEmpty());
  const LatticePoint place = moved(grid.undisplaced(9), yMax, 5);
  grid.move(9, place);
  grid.move(3, moved(grid.undisplaced(3), xMin, 1));
  EXPECT_THAT(grid.displacedPoints(), ElementsAre(3, 9));
  EXPECT_EQ(grid.displacedCount(), 2U);
  EXPECT_EQ(grid.place(9), place);
  EXPECT_EQ(grid.place(8), grid.undisplaced(8));
  EXPECT_EQ(grid.undisplaced(9), of.grid.place(9));
  EXPECT_TRUE(grid.isDisplaced(9));
  EXPECT_FALSE(grid.isDisplaced(8));
  grid.undisplace(3);
  EXPECT_THAT(grid.displacedPoints(), ElementsAre(9));
  grid.move(9, moved(place, xMax, 1));
  EXPECT_EQ(grid.displacedCount(), 1U) << "the last place holds";
  EXPECT_EQ(grid.place(9), moved(place, xMax, 1));
}

/// A point with an edge to another one.
std::pair<Index, GridPlaces::Edge> someEdge(const RandomGrid& of, int direction)
{
  for (Index point = 0; point < of.points.size(); ++point)
  {
    if (const GridPlaces::Edge edge = of.grid.edge(point, direction); edge.other != noIndex)
    {
      return {point, edge};
    }
  }
  return {noIndex, {}};
}

TEST(GridPlaces, TryPlacesWithoutMovingAnything)
{
  const RandomGrid of(9);
  GridPlaces grid(of.octree, of.points);
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto [point, edge] = someEdge(of, direction);
    ASSERT_NE(point, noIndex);
    const LatticePoint start = grid.undisplaced(point);
    const LatticePoint end = grid.undisplaced(edge.other);
    const GridTrial here{point, moved(start, yMax, 3)};
    const GridTrial there{edge.other, moved(end, zMin, 2)};
    const GridTrial still{point, start};
    EXPECT_EQ(grid.place(point, here), here.place);
    EXPECT_EQ(grid.place(edge.other, here), end);
    EXPECT_TRUE(grid.isDisplaced(point, here));
    EXPECT_FALSE(grid.isDisplaced(point, still)) << "at its own place";
    EXPECT_FALSE(grid.isDisplaced(edge.other, here));
    EXPECT_FALSE(grid.isDisplaced(point, edge));
    EXPECT_TRUE(grid.isDisplaced(point, edge, here) && grid.isDisplaced(point, edge, there));
    EXPECT_FALSE(grid.isDisplaced(point, edge, still));
    const EdgeSegment atStart = grid.segment(point, direction, edge, here);
    EXPECT_EQ(std::tie(atStart.start, atStart.end, atStart.axis), std::make_tuple(here.place, end, -1));
    const EdgeSegment atEnd = grid.segment(point, direction, edge, there);
    EXPECT_EQ(std::tie(atEnd.start, atEnd.end, atEnd.axis), std::make_tuple(start, there.place, -1));
    EXPECT_EQ(grid.segment(point, direction, edge, still).axis, axisOf(direction));
    grid.move(edge.other, there.place);
    EXPECT_EQ(grid.segment(point, direction, edge).end, there.place);
    EXPECT_FALSE(grid.isDisplaced(edge.other, GridTrial{edge.other, end})) << "a trial takes it back";
    grid.undisplace(edge.other);
  }
}

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

Vec3 cornerPlace(std::uint8_t corner)
{
  const unsigned bits = hexahedronCorner.at(corner);
  return {bits & 1 ? 1.0 : 0.0, bits & 2 ? 1.0 : 0.0, bits & 4 ? 1.0 : 0.0};
}

TEST(DualMesh, HasFacesOutwardsOnTheirSides)
{
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto& face = hexahedronFace.at(static_cast<std::size_t>(direction));
    const int axis = axisOf(direction);
    for (const std::uint8_t c : face)
    {
      EXPECT_EQ(cornerPlace(c)[axis], isUpper(direction) ? 1.0 : 0.0);
    }
    const Vec3 u = cornerPlace(face[1]) - cornerPlace(face[0]);
    const Vec3 v = cornerPlace(face[2]) - cornerPlace(face[1]);
    EXPECT_EQ(u.cross(v)[axis], isUpper(direction) ? 1.0 : -1.0);
    EXPECT_EQ(cornerPlace(face[3]), cornerPlace(face[0]) + v);
  }
}

TEST(DualMesh, ReducesFacesByNeighboringCornersThatAreOne)
{
  for (unsigned merged = 0; merged < 16; ++merged)
  {
    std::array<Index, 4> loop{10, 11, 12, 13}; // corner i + 1 is corner i where bit i is set
    for (std::size_t i = 0; i < 4; ++i)
    {
      if ((merged >> i & 1) != 0)
      {
        std::ranges::replace(loop, loop.at((i + 1) % 4), loop.at(i));
      }
    }
    std::vector<Index> expected;
    for (std::size_t i = 0; i < 4; ++i)
    {
      expected.insert(expected.end(), loop.at(i) != loop.at((i + 3) % 4) ? 1 : 0, loop.at(i));
    }
    for (int direction = 0; direction < 6; ++direction)
    {
      std::array<Index, 8> corners{0, 1, 2, 3, 4, 5, 6, 7};
      for (std::size_t i = 0; i < 4; ++i)
      {
        corners.at(hexahedronFace.at(static_cast<std::size_t>(direction)).at(i)) = loop.at(i);
      }
      const ReducedFace face = faceOf(corners, direction);
      std::vector<Index> found(face.loop().begin(), face.loop().end());
      EXPECT_EQ(found.size() < 3, expected.size() < 3) << merged;
      const auto begin = std::ranges::find(found, expected.empty() ? noIndex : expected[0]);
      std::rotate(found.begin(), begin, found.end());
      EXPECT_TRUE(expected.size() < 3 || found == expected) << merged;
    }
  }
}

TEST(DualMesh, CodesNeighbors)
{
  EXPECT_FALSE(DualMesh::isBoundary(DualMesh::noFace));
  EXPECT_FALSE(DualMesh::isBoundary(0));
  for (const Index face : {0U, 1U, 77U})
  {
    const std::int32_t code = ~static_cast<std::int32_t>(face);
    EXPECT_TRUE(DualMesh::isBoundary(code));
    EXPECT_EQ(DualMesh::boundaryFaceOf(code), face);
  }
}

/// Names a face of the block's outside, or an inner face: the element below it and an upper direction.
using IsSheet = std::function<bool(Index element, int direction)>;

/// Cubes of 1 m in rows along x. Inner faces that are sheets have boundary faces of tag 6 on both sides.
class Block
{
public:
  Block(std::array<Index, 3> count, const IsSheet& isSheet) : size(count)
  {
    for (Index i = 0; i < (size[0] + 1) * (size[1] + 1) * (size[2] + 1); ++i)
    {
      mesh.points.emplace_back(i % (size[0] + 1), i / (size[0] + 1) % (size[1] + 1),
                               i / ((size[0] + 1) * (size[1] + 1)));
    }
    for (Index e = 0; e < size[0] * size[1] * size[2]; ++e)
    {
      mesh.corners.push_back(cornersOf(e));
      mesh.neighbors.push_back({});
      mesh.levels.push_back(std::uint8_t{0});
      mesh.zones.push_back(std::int32_t{0});
    }
    for (Index e = 0; e < mesh.elementCount(); ++e)
    {
      for (int direction = 0; direction < 6; ++direction)
      {
        link(e, direction, isSheet);
      }
    }
  }

  DualMesh mesh;

private:
  std::array<Index, 3> cellOf(Index e) const { return {e % size[0], e / size[0] % size[1], e / (size[0] * size[1])}; }

  std::array<Index, 8> cornersOf(Index e) const
  {
    const auto [i, j, k] = cellOf(e);
    std::array<Index, 8> corners{};
    for (std::size_t c = 0; c < 8; ++c)
    {
      const Index bits = hexahedronCorner.at(c);
      corners.at(c) = i + (bits & 1) + (size[0] + 1) * (j + (bits >> 1 & 1) + (size[1] + 1) * (k + (bits >> 2)));
    }
    return corners;
  }

  void link(Index e, int direction, const IsSheet& isSheet)
  {
    const auto axis = static_cast<std::size_t>(axisOf(direction));
    const std::array<Index, 3> steps{1, size[0], size[0] * size[1]};
    const Index place = cellOf(e).at(axis);
    const bool isOutside = isUpper(direction) ? place + 1 == size.at(axis) : place == 0;
    const Index next = isUpper(direction) ? e + steps.at(axis) : e - steps.at(axis);
    const Index below = isUpper(direction) ? e : next;
    std::int32_t& code = mesh.neighbors[e].at(static_cast<std::size_t>(direction));
    if (!isOutside && !isSheet(below, direction | 1))
    {
      code = static_cast<std::int32_t>(next);
      return;
    }
    code = ~static_cast<std::int32_t>(mesh.boundaryFaces.size());
    const auto side = isUpper(direction) ? SheetSide::back : SheetSide::front;
    const Index tag = isOutside ? static_cast<Index>(direction) : 6;
    mesh.boundaryFaces.push_back(
        {e, tag, isOutside ? noIndex : next, static_cast<std::uint8_t>(direction), side, isOutside, noIndex});
  }

  std::array<Index, 3> size;
};

bool noSheet(Index /*element*/, int /*direction*/) { return false; }

TEST(DualMesh, AppendsElementsWithTheLabelsOfOthers)
{
  DualMesh from = Block({2, 1, 1}, noSheet).mesh;
  from.levels[1] = 7;
  from.zones[1] = 5;
  from.rooms.assign(2, 0);
  from.cellZones.assign(2, 0);
  from.rooms[1] = 3;
  from.cellZones[1] = 4;
  const std::array<Index, 8> corners{8, 7, 6, 5, 4, 3, 2, 1};
  const std::array<std::int32_t, 6> neighbors{1, 2, 3, 4, 5, 6};
  appendElement(from, corners, neighbors, from, 1);
  EXPECT_EQ(from.corners[2], corners);
  EXPECT_EQ(from.neighbors[2], neighbors);
  EXPECT_EQ(from.levels[2], 7);
  EXPECT_EQ(from.zones[2], 5);
  EXPECT_EQ(from.rooms[2], 3);
  EXPECT_EQ(from.cellZones[2], 4);
  DualMesh bare = Block({1, 1, 1}, noSheet).mesh;
  appendElement(bare, corners, neighbors, bare, 0);
  EXPECT_EQ(bare.elementCount(), 2U);
  EXPECT_TRUE(bare.rooms.empty() && bare.cellZones.empty());
}

TEST(DualMesh, MarksPoints)
{
  const DualMesh mesh = Block({3, 3, 3}, noSheet).mesh;
  const ThreadExecutor executor(3);
  const std::vector<char> onBoundary = boundaryPoints(mesh, executor);
  std::vector<char> inZones(mesh.points.size(), 0);
  DualMesh zoned = mesh;
  zoned.zoneFaces = {{13, 0, xMax, SheetSide::front}};
  markZonePoints(zoned, inZones);
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    const Vec3& at = mesh.points[p];
    EXPECT_EQ(onBoundary[p] != 0, at.minCoeff() < 0.5 || at.maxCoeff() > 2.5);
    const bool isOnFace = at[0] == 2.0 && at[1] > 0.5 && at[1] < 2.5 && at[2] > 0.5 && at[2] < 2.5;
    EXPECT_EQ(inZones[p] != 0, isOnFace) << at.transpose();
  }
  for (std::size_t c = 0; c < 8; ++c)
  {
    std::vector<char> marked(mesh.points.size(), 0);
    marked[mesh.corners[13].at(c)] = 1;
    EXPECT_TRUE(hasMarked(mesh.corners[13], marked));
  }
  EXPECT_FALSE(hasMarked(mesh.corners[13], std::vector<char>(mesh.points.size(), 0)));
}

FaceFlux sumOfFluxes(const DualMesh& mesh, Index element, const Vec3& origin)
{
  FaceFlux sum;
  for (int direction = 0; direction < 6; ++direction)
  {
    const FaceFlux flux = fluxOf(mesh, element, direction, origin);
    sum.area += flux.area;
    sum.volume += flux.volume;
  }
  return sum;
}

TEST(FaceFlux, OfAllFacesIsTheVolumeFromAnyOrigin)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-1, 1);
  for (int round = 0; round < 50; ++round)
  {
    DualMesh mesh = Block({1, 1, 1}, noSheet).mesh;
    Eigen::Matrix3d turn;
    turn.setZero();
    turn = turn.unaryExpr([&](double) { return some(random); });
    for (Vec3& p : mesh.points)
    {
      p = turn * p + Vec3(3, -2, 1);
    }
    const FaceFlux sum = sumOfFluxes(mesh, 0, Vec3(some(random), some(random), some(random)));
    EXPECT_NEAR(sum.volume, turn.determinant(), 1e-12);
    EXPECT_NEAR(sum.area.norm(), 0.0, 1e-12);
  }
}

TEST(FaceFlux, HasAreasOutwardsAndNoneOfFacesThatAreNone)
{
  DualMesh mesh = Block({1, 1, 1}, noSheet).mesh;
  for (Vec3& p : mesh.points)
  {
    p = p.cwiseProduct(Vec3(2, 3, 5));
  }
  const std::array<double, 3> areas{15, 10, 6};
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto axis = static_cast<std::size_t>(axisOf(direction));
    const Vec3 expected = (isUpper(direction) ? 1 : -1) * areas.at(axis) * Vec3::Unit(axisOf(direction));
    EXPECT_NEAR((fluxOf(mesh, 0, direction, Vec3(7, 8, 9)).area - expected).norm(), 0.0, 1e-12);
  }
  // A wedge: the face at the upper x becomes an edge.
  for (const auto& [gone, kept] : {std::pair(1, 2), {5, 6}})
  {
    mesh.corners[0].at(static_cast<std::size_t>(gone)) = mesh.corners[0].at(static_cast<std::size_t>(kept));
  }
  EXPECT_NEAR(sumOfFluxes(mesh, 0, Vec3(1, 1, 1)).volume, 15.0, 1e-12);
  EXPECT_EQ(fluxOf(mesh, 0, xMax, Vec3::Zero()).area, Vec3(Vec3::Zero()));
  EXPECT_NEAR((fluxOf(mesh, 0, zMax, Vec3::Zero()).area - Vec3(0, 0, 3)).norm(), 0.0, 1e-12);
}

TEST(MetSides, AreThoseThatFacesLieOn)
{
  DualMesh mesh;
  mesh.boundaryFaces = {{0, 0, noIndex, xMin, SheetSide::front, false},
                        {0, 1, 5, xMin, SheetSide::back, false},
                        {0, 2, noIndex, xMin, SheetSide::front, false},
                        {0, 2, 3, xMin, SheetSide::back, false},
                        {0, 4 + zMax, noIndex, xMin, SheetSide::back, true}};
  mesh.zoneFaces = {{0, 3, xMin, SheetSide::front}};
  const auto textOf = [](const MetSides& met) {
    return std::string(met.front ? "f" : "") + (met.back ? "b" : "") + (met.atOnce ? "o" : "") +
           (met.within ? "w" : "");
  };
  const auto textsOf = [&](const std::vector<char>& hasOpposite) {
    std::vector<std::string> texts;
    std::ranges::transform(findMetSides(mesh, 4, hasOpposite), std::back_inserter(texts), textOf);
    EXPECT_EQ(texts.size(), 4U + sideNumbers);
    EXPECT_EQ(std::accumulate(texts.begin() + 4, texts.end(), std::string()), texts[4 + zMax]);
    texts[4] = texts[4 + zMax];
    texts.resize(5);
    return texts;
  };
  EXPECT_THAT(textsOf({}), ElementsAre("f", "bo", "fbo", "w", "b"));
  EXPECT_THAT(textsOf({1, 0, 0, 0, 0}), ElementsAre("fo", "b", "fb", "w", "b")) << "as given";
}

TEST(MetSides, HaveTwoSidesApartOnlyIfSomeFaceHasBothAtOnce)
{
  for (unsigned bits = 0; bits < 16; ++bits)
  {
    const MetSides met{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0};
    EXPECT_EQ(met.isTwoSided(), (bits & 7) == 7);
    EXPECT_EQ(met.hasBoundary(), (bits & 3) != 0);
    for (unsigned more = 0; more < 16; ++more)
    {
      MetSides sum = met;
      sum.add({(more & 1) != 0, (more & 2) != 0, (more & 4) != 0, (more & 8) != 0});
      const unsigned both = bits | more;
      EXPECT_TRUE(sum.front == ((both & 1) != 0) && sum.back == ((both & 2) != 0));
      EXPECT_TRUE(sum.atOnce == ((both & 4) != 0) && sum.within == ((both & 8) != 0));
    }
  }
}

TEST(OwnElements, AreAllUnlessSomethingElseIsSaid)
{
  const OwnElements all;
  EXPECT_TRUE(all.owns(0) && all.owns(99) && all.isWhole());
  OwnElements some;
  some.isOwn = [](Index element) { return element > 3; };
  EXPECT_FALSE(some.owns(3));
  EXPECT_TRUE(some.owns(4));
}

/// The sectors of the elements around a point, by flooding through inner faces at the point, in order of elements.
std::map<Index, Index> sectorsAt(const DualMesh& mesh, Index point)
{
  std::map<Index, Index> sectors;
  Index count = 0;
  const auto has = [&](Index e, std::size_t direction) {
    return std::ranges::any_of(hexahedronFace.at(direction),
                               [&](std::uint8_t c) { return mesh.corners[e].at(c) == point; });
  };
  for (Index seed = 0; seed < mesh.elementCount(); ++seed)
  {
    std::vector<Index> open;
    if (std::ranges::count(mesh.corners[seed], point) > 0 && !sectors.contains(seed))
    {
      sectors[seed] = count++;
      open.push_back(seed);
    }
    while (!open.empty())
    {
      const Index e = open.back();
      open.pop_back();
      for (std::size_t direction = 0; direction < 6; ++direction)
      {
        const std::int32_t next = mesh.neighbors[e].at(direction);
        if (next >= 0 && has(e, direction) && sectors.try_emplace(static_cast<Index>(next), sectors[e]).second)
        {
          open.push_back(static_cast<Index>(next));
        }
      }
    }
  }
  return sectors;
}

void expectSplit(const DualMesh& before, const Executor& executor)
{
  DualMesh expected = before;
  std::vector<Index> sources;
  for (Index point = 0; point < before.points.size(); ++point)
  {
    const Index first = static_cast<Index>(expected.points.size()) - 1;
    Index most = 0;
    for (const auto& [element, sector] : sectorsAt(before, point))
    {
      most = std::max(most, sector);
      std::ranges::replace(expected.corners[element], point, sector == 0 ? point : first + sector);
    }
    expected.points.insert(expected.points.end(), most, before.points[point]);
    sources.insert(sources.end(), most, point);
  }
  DualMesh mesh = before;
  EXPECT_EQ(splitSheets(mesh, quietContext(executor)), sources);
  EXPECT_EQ(mesh.points, expected.points);
  EXPECT_EQ(mesh.corners, expected.corners);
  EXPECT_EQ(mesh.neighbors, before.neighbors);
}

TEST(Sheets, GiveEachSectorAroundAPointItsCopy)
{
  std::mt19937 random(4);
  const SerialExecutor serial;
  const ThreadExecutor threads(3);
  for (int round = 0; round < 60; ++round)
  {
    std::set<std::pair<Index, int>> sheets;
    for (Index e = 0; e < 27; ++e)
    {
      for (const int direction : {xMax, yMax, zMax})
      {
        if (static_cast<int>(random() % 60) < round)
        {
          sheets.emplace(e, direction);
        }
      }
    }
    const Block block({3, 3, 3}, [&](Index e, int direction) { return sheets.contains({e, direction}); });
    expectSplit(block.mesh, round % 2 == 0 ? static_cast<const Executor&>(serial) : threads);
  }
}

TEST(Sheets, KeepTheirBoundaryEdgesWholeAndPartAtJunctions)
{
  const auto copiesOf = [](std::array<Index, 3> size, const std::set<std::pair<Index, int>>& sheets) {
    DualMesh mesh = Block(size, [&](Index e, int direction) { return sheets.contains({e, direction}); }).mesh;
    return splitSheets(mesh, quietContext()).size();
  };
  EXPECT_EQ(copiesOf({2, 2, 1}, {}), 0U);
  EXPECT_EQ(copiesOf({2, 1, 1}, {{0, xMax}}), 4U) << "a sheet across parts all points";
  EXPECT_EQ(copiesOf({2, 2, 1}, {{0, xMax}}), 2U) << "but not those of its boundary edge";
  EXPECT_EQ(copiesOf({2, 2, 1}, {{0, xMax}, {2, xMax}}), 6U);
  EXPECT_EQ(copiesOf({2, 2, 1}, {{0, xMax}, {2, xMax}, {0, yMax}}), 6U + 2U + 2U) << "a junction has three sectors";
}

} // namespace
