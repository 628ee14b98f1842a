// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the edges of grid points, against a look at the octree, and points that are moved.
#include "Dual/Grid/GridPlaces.h"
#include "GridSamples.h"
#include "Octree/Tree/Balance.h"
#include "Support/QuietContext.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

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

} // namespace
