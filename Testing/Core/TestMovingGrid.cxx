// SPDX-License-Identifier: GPL-3.0-or-later
/// What a grid says about its leaves and points does not depend on how its points came to where they are, and the
/// search for places leaves less to say.
#include "FoundZones.h"

#include "Dual/Displacement/MovingGrid.h"
#include "Dual/Displacement/PlaceMoves.h"
#include "Dual/Displacement/PlaceSearch.h"
#include "Dual/Displacement/ZonesApart.h"
#include "Dual/Grid/Crossings.h"
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Surface/Model/TriangleTree.h"

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace atria;

using PointPlaces = MovingGrid::PointPlaces;

/// Some points and places up to half an octant from home, neighbors among them.
PointPlaces somePlaces(const GridPlaces& grid, unsigned seed)
{
  std::mt19937 random(seed);
  const std::int64_t half = grid.octree().frame().latticeSize(grid.octree().frame().depth) / 2;
  std::uniform_int_distribution<std::int64_t> shift(-half, half);
  PointPlaces places;
  for (Index point = 0; point < grid.points().size(); ++point)
  {
    if (random() % 4 == 0)
    {
      const LatticePoint undisplaced = grid.undisplaced(point);
      places.emplace_back(point, LatticePoint{undisplaced[0] + shift(random), undisplaced[1] + shift(random),
                                              undisplaced[2] + shift(random)});
    }
  }
  return places;
}

/// A grid that is moved, with all it needs.
struct Moving
{
  Moving(const atria::testing::Meshed& meshed, const GridPoints& points, const Crossings& undisplaced,
         const RunContext& context)
      : places(meshed.octree, points), tree(meshed.model),
        grid(places, undisplaced, MeshingContext{context, meshed.octree, meshed.model, tree})
  {
  }

  GridPlaces places;
  TriangleTreeOnDemand tree;
  MovingGrid grid;
};

void expectSameCuts(std::span<const CutEdge> l, std::span<const CutEdge> r)
{
  ASSERT_EQ(l.size(), r.size());
  for (std::size_t i = 0; i < l.size(); ++i)
  {
    EXPECT_EQ(l[i].beside, r[i].beside);
    EXPECT_TRUE(std::ranges::equal(l[i].cuts, r[i].cuts, [](const SurfaceCrossing& a, const SurfaceCrossing& b) {
      return a.triangle == b.triangle && a.orientation == b.orientation && a.parameter == b.parameter;
    }));
  }
}

void expectSame(Moving& l, Moving& r, const RunContext& context)
{
  MovingGrid::Look ofL(l.grid);
  MovingGrid::Look ofR(r.grid);
  for (Index leaf = 0; leaf < l.grid.octree().leafCount(); ++leaf)
  {
    ASSERT_EQ(l.grid.surplus(leaf, ofL), r.grid.surplus(leaf, ofR)) << leaf;
    expectSameCuts(ofL.cutEdges(), ofR.cutEdges());
    EXPECT_EQ(ofL.leavesAbout(), ofR.leavesAbout());
  }
  EXPECT_EQ(l.grid.unresolvedLeaves(context), r.grid.unresolvedLeaves(context));
}

class MovedGrids : public ::testing::TestWithParam<unsigned>
{
protected:
  MovedGrids() : meshed(atria::testing::meshIt(atria::testing::randomSoup(GetParam()), options()))
  {
    points = findGridPoints(meshed.octree, context);
    undisplaced = findCrossings(GridPlaces(meshed.octree, points), meshed.model, context);
  }

  static GridOptions options()
  {
    GridOptions options;
    options.domain = {Vec3::Constant(-4.3), Vec3::Constant(4.1)};
    options.sizeMin = 0.4;
    options.sizeMid = 0.4;
    options.sizeMax = 0.8;
    return options;
  }

  ThreadExecutor executor{3};
  RunContext context = atria::testing::quietContext(executor);
  atria::testing::Meshed meshed;
  GridPoints points;
  Crossings undisplaced;
};

TEST_P(MovedGrids, AreTheSameMovedAtOnceAndPointByPoint)
{
  Moving atOnce(meshed, points, undisplaced, context);
  Moving oneByOne(meshed, points, undisplaced, context);
  for (const unsigned seed : {1u, 2u, 3u})
  {
    const PointPlaces places = somePlaces(atOnce.places, seed);
    ASSERT_FALSE(places.empty());
    atOnce.grid.moveAll(places, context);
    for (const auto& [point, place] : places)
    {
      oneByOne.grid.moveTo(point, place);
    }
    expectSame(atOnce, oneByOne, context);
  }
}

TEST_P(MovedGrids, TellTheSameOfPointsWhetherLeavesWereLookedAtOrNot)
{
  Moving looked(meshed, points, undisplaced, context);
  Moving stale(meshed, points, undisplaced, context);
  const PointPlaces places = somePlaces(looked.places, GetParam());
  looked.grid.moveAll(places, context);
  looked.grid.lookAgain(context);
  stale.grid.moveAll(places, context);
  MovingGrid::Look ofLooked(looked.grid);
  MovingGrid::Look ofStale(stale.grid);
  double sum = 0.0;
  for (Index point = 0; point < points.size(); ++point)
  {
    const double cost = looked.grid.surplusAbout(point, ofLooked).cost();
    ASSERT_EQ(cost, stale.grid.surplusAbout(point, ofStale).cost()) << point;
    ASSERT_EQ(cost, stale.grid.surplusAbout(point, stale.places.place(point), ofStale).cost()) << point;
    sum += cost;
  }
  EXPECT_GT(sum, 0.0);
}

TEST_P(MovedGrids, CostLessAfterTheSearchForPlaces)
{
  Moving moving(meshed, points, undisplaced, context);
  PlaceMoves moves(moving.grid, context);
  const auto cost = [&] {
    MovingGrid::Look look(moving.grid);
    double sum = 0.0;
    for (Index point = 0; point < points.size(); ++point)
    {
      sum += moving.grid.surplusAbout(point, look).cost();
    }
    return sum;
  };
  PointPlaces start = somePlaces(moving.places, GetParam());
  std::erase_if(start, [&](const auto& moved) { return moving.grid.isFixed(moved.first); });
  moving.grid.moveAll(start, context);
  const std::size_t unresolved = moving.grid.unresolvedLeaves(context).size();
  const double before = cost();
  ASSERT_GT(unresolved, 0u);
  searchPlaces(moving.grid, context);
  EXPECT_LT(cost(), before);
  EXPECT_LT(moving.grid.unresolvedLeaves(context).size(), unresolved);
  Index displaced = 0;
  for (Index point = 0; point < points.size(); ++point)
  {
    displaced += moving.places.place(point) != moving.places.undisplaced(point) ? 1 : 0;
    EXPECT_TRUE(!moving.grid.isFixed(point) || moving.places.place(point) == moving.places.undisplaced(point)) << point;
  }
  EXPECT_GT(displaced, 0u);
  // What was moved one by one is at its best: no point at an unresolved leaf gains by moving alone.
  std::set<Index> corners;
  for (const Index leaf : moving.grid.unresolvedLeaves(context))
  {
    moving.grid.addCorners(leaf, corners);
  }
  std::erase_if(corners, [&](Index point) { return moving.grid.isFixed(point); });
  moving.grid.lookAgain(context);
  for (const PlaceMove& move : moves.best({corners.begin(), corners.end()}))
  {
    EXPECT_LE(move.gain, smallestGain) << "point " << move.point;
  }
}

TEST_P(MovedGrids, AreAsTheyWereWhenATrialIsTakenBack)
{
  Moving tried(meshed, points, undisplaced, context);
  Moving untouched(meshed, points, undisplaced, context);
  PlaceMoves moves(tried.grid, context);
  for (const unsigned seed : {4u, 5u})
  {
    PointPlaces places = somePlaces(tried.places, seed);
    places.resize(std::min<std::size_t>(places.size(), 40));
    tried.grid.lookAgain(context);
    MovingGrid::Trail trail;
    moves.make(places, trail);
    tried.grid.takeBack(trail);
  }
  expectSame(tried, untouched, context);
}

INSTANTIATE_TEST_SUITE_P(Soups, MovedGrids, ::testing::Values(1u, 2u, 3u));

TEST(ZonesApart, AMovedPointThroughWhichTwoZonesMeetGoesBack)
{
  atria::testing::FoundZones found({}, atria::testing::uniformGrid({Vec3::Constant(-2), Vec3::Constant(2)}, 0.5));
  const auto across = [&](Index point) { return found.grid.undisplaced(point)[0]; };
  const auto moved = static_cast<Index>(found.points.size() / 2);
  std::vector<Index> apart(found.points.size());
  for (Index point = 0; point < apart.size(); ++point)
  {
    apart[point] = across(point) == across(moved) ? noIndex : across(point) < across(moved) ? 0 : 1;
  }
  EXPECT_TRUE(joiningPoints(found.grid, found.crossings, apart).empty());
  found.grid.move(moved, found.grid.undisplaced(moved));
  EXPECT_EQ(joiningPoints(found.grid, found.crossings, apart), std::vector<Index>{moved});
  std::ranges::replace(apart, Index{1}, Index{0});
  EXPECT_TRUE(joiningPoints(found.grid, found.crossings, apart).empty());
}

} // namespace
