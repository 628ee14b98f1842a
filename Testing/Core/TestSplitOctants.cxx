// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Tree/Balance.h"
#include "Octree/Tree/SplitOctants.h"
#include "Support/QuietContext.h"
#include "Support/RandomOctrees.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace {

using namespace atria;
using namespace atria::testing;

/// An octree of 4 x 4 x 4 octants of size 8, of which those in `families` of eight are refined once. Families are
/// numbered by bits x 1, y 2, z 4.
Octree octreeOf(const GridFrame& frame, std::initializer_list<MortonKey> families)
{
  RefinedSets sets{{0}, {}, {}};
  for (MortonKey key = 0; key < 8; ++key)
  {
    sets[1].push_back(key);
  }
  for (const MortonKey family : families)
  {
    for (MortonKey child = 0; child < 8; ++child)
    {
      sets[2].push_back(family << 3 | child);
    }
  }
  return Octree(frame, sets);
}

class SplitOctantsOf : public ::testing::Test
{
protected:
  GridFrame frame = frameOfDepth(5, {31.0, 31.0, 31.0});

  std::size_t countSplit(const Octree& octree) const
  {
    const SplitOctants split(octree, quietContext());
    std::size_t count = 0;
    for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
    {
      count += split.isSplit(leaf) ? 1 : 0;
    }
    return count;
  }
};

TEST_F(SplitOctantsOf, OneSizeSplitNothing)
{
  EXPECT_EQ(countSplit(octreeOf(frame, {})), 0U);
  EXPECT_EQ(countSplit(octreeOf(frame, {0, 1, 2, 3, 4, 5, 6, 7})), 0U);
}

TEST_F(SplitOctantsOf, TwoSizesSplitTheLargerOctantsAtFacesAndEdges)
{
  // At each of three faces four octants touch the refined family, at each of three edges two, at its corner one.
  EXPECT_EQ(countSplit(octreeOf(frame, {0})), 3U * 4U + 3U * 2U);
  // The border is a plane of four by four octants.
  EXPECT_EQ(countSplit(octreeOf(frame, {0, 2, 4, 6})), 16U);
}

TEST_F(SplitOctantsOf, BesideAPlaneBorderHaveFourParts)
{
  const Octree octree = octreeOf(frame, {0, 2, 4, 6});
  const SplitOctants split(octree, quietContext());
  std::map<LatticePoint, int> found;
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    if (!split.isSplit(leaf))
    {
      continue;
    }
    const LatticePoint low = octree.lowCorner(leaf);
    const LatticePoint high = octree.highCorner(leaf);
    std::set<SplitCell> cells;
    for (const LatticePoint& point : split.pointsOf(leaf))
    {
      ++found[point];
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_GE(point[axis], low[axis]);
        EXPECT_LE(point[axis], high[axis]);
      }
      for (unsigned direction = 0; direction < 8; ++direction)
      {
        bool isWithin = true;
        for (int axis = 0; axis < 3; ++axis)
        {
          const std::int64_t beside = point[axis] + ((direction >> axis & 1) != 0 ? 1 : -1);
          isWithin = isWithin && beside > low[axis] && beside < high[axis];
        }
        if (isWithin)
        {
          cells.insert(split.cellAt(leaf, point, direction));
        }
      }
    }
    EXPECT_EQ(cells.size(), 4U);
    for (const SplitCell cell : cells)
    {
      EXPECT_EQ(leafOf(cell), leaf);
      const LatticeBox bounds = split.boundsOf(cell);
      for (int axis = 0; axis < 3; ++axis)
      {
        EXPECT_GE(bounds.low[axis], low[axis]);
        EXPECT_LE(bounds.high[axis], high[axis]);
      }
    }
  }
  std::map<std::int64_t, int> depths;
  for (const auto& [point, count] : found)
  {
    ++depths[point[0]];
  }
  EXPECT_EQ(depths.size(), 2U) << "the caps of the slabs along y and along z";
}

TEST_F(SplitOctantsOf, HaveTheCountedPoints)
{
  const GridFrame odd = frameOfDepth(5, {29.5, 22.3, 31.0}); // sides cut octants
  std::mt19937 random(29);
  for (int i = 0; i < 20; ++i)
  {
    SCOPED_TRACE(i);
    const GridFrame& within = i % 2 == 0 ? frame : odd;
    RefinedSets sets = randomSets(within, random);
    balance(sets, within, quietContext(), 1, true);
    const Octree octree(within, sets);
    const SplitOctants split(octree, quietContext());
    std::set<LatticePoint> points;
    for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
    {
      for (const LatticePoint& point : split.isSplit(leaf) ? split.pointsOf(leaf) : std::vector<LatticePoint>())
      {
        points.insert(point);
      }
    }
    std::erase_if(points, [&](const LatticePoint& point) { return !within.inDomain(point); });
    EXPECT_FALSE(points.empty());
    EXPECT_EQ(countSplitPoints(sets, within, quietContext()), points.size());
  }
}

} // namespace
