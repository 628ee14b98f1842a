// SPDX-License-Identifier: GPL-3.0-or-later
/// Rows of leaves, and blocks of them, of random octrees against their leaves one by one.
#include "Octree/Tree/Balance.h"
#include "Octree/Tree/LeafRows.h"
#include "Support/QuietContext.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace {

using namespace atria;
using atria::testing::quietContext;

struct RandomOctree
{
  GridFrame frame;
  RefinedSets refined;
  Octree octree;
};

/// About random points, balanced; in one of two the domain is flat.
RandomOctree randomOctree(unsigned seed)
{
  std::mt19937 random(seed);
  RandomOctree out;
  GridOptions options;
  options.domain = {Vec3::Zero(), Vec3(30.0, 27.0, seed % 2 == 0 ? 9.0 : 30.0)};
  options.sizeMid = 1.0;
  options.sizeMax = 4.0;
  options.startLevel = 1;
  out.frame = makeGridFrame(options, options.domain);
  const int depth = out.frame.depth;
  out.refined.resize(static_cast<std::size_t>(depth));
  const unsigned count = 1 + random() % 60;
  for (unsigned i = 0; i < count; ++i)
  {
    const MortonKey finest = random() % (MortonKey{1} << 3 * depth);
    const int levels = 1 + static_cast<int>(random() % static_cast<unsigned>(depth));
    for (int level = 0; level < levels; ++level)
    {
      out.refined[static_cast<std::size_t>(level)].push_back(finest >> 3 * (depth - level));
    }
  }
  for (std::vector<MortonKey>& keys : out.refined)
  {
    std::ranges::sort(keys);
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  }
  balance(out.refined, out.frame, quietContext());
  out.octree = Octree(out.frame, out.refined);
  return out;
}

/// By leaf, whether it is in the masks.
std::vector<char> leavesIn(const LeafMasks& masks, const RandomOctree& of)
{
  std::vector<char> isIn(of.octree.leafCount());
  for (Index leaf = 0; leaf < isIn.size(); ++leaf)
  {
    const auto parent = static_cast<std::size_t>(of.octree.level(leaf)) - 1;
    const MortonKey key = of.octree.key(leaf);
    std::size_t octant = 0;
    for (std::size_t level = 0; level < parent; ++level)
    {
      octant += of.refined[level].size();
    }
    octant +=
        static_cast<std::size_t>(std::ranges::lower_bound(of.refined[parent], key >> 3) - of.refined[parent].begin());
    isIn[leaf] = masks[octant] >> (key & 7) & 1;
  }
  return isIn;
}

bool touch(const Octree& octree, Index a, Index b)
{
  const LatticePoint lowA = octree.lowCorner(a), highA = octree.highCorner(a);
  const LatticePoint lowB = octree.lowCorner(b), highB = octree.highCorner(b);
  bool does = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    does = does && lowA[axis] <= highB[axis] && lowB[axis] <= highA[axis];
  }
  return does;
}

std::vector<char> grown(std::vector<char> leaves, int rows, const std::vector<char>& within, const Octree& octree)
{
  for (int row = 0; row < rows; ++row)
  {
    std::vector<char> next = leaves;
    for (Index a = 0; a < leaves.size(); ++a)
    {
      for (Index b = 0; leaves[a] && b < leaves.size(); ++b)
      {
        next[b] |= within[b] && touch(octree, a, b) ? 1 : 0;
      }
    }
    leaves = std::move(next);
  }
  return leaves;
}

TEST(LeafRows, FindsLeavesByTheirKeys)
{
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    const RandomOctree of = randomOctree(seed);
    std::mt19937 random(seed);
    std::vector<char> chosen(of.octree.leafCount());
    std::vector<MortonKey> keys;
    for (Index leaf = 0; leaf < chosen.size(); ++leaf)
    {
      chosen[leaf] = random() % 3 == 0 ? 1 : 0;
      if (chosen[leaf])
      {
        keys.push_back(of.octree.finestKey(leaf));
      }
    }
    EXPECT_EQ(leavesIn(LeafRows(of.refined, of.frame).of(keys), of), chosen);
  }
}

TEST(LeafRows, AreThoseOfLeavesThatTouch)
{
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    const RandomOctree of = randomOctree(seed);
    const LeafRows rows(of.refined, of.frame);
    const std::vector<char> inDomain = leavesIn(rows.inDomain(), of);
    for (Index leaf = 0; leaf < inDomain.size(); ++leaf)
    {
      EXPECT_EQ(inDomain[leaf] != 0, of.octree.inDomain(leaf));
    }
    const auto first = static_cast<Index>(of.octree.leafCount() / 3);
    const MortonRange range{of.octree.finestKey(first), of.octree.finestKey(first + first / 2 + 1)};
    const LeafMasks start = rows.in(range);
    const std::vector<char> own = leavesIn(start, of);
    EXPECT_EQ(std::accumulate(own.begin(), own.end(), Index{0}), first / 2 + 1);
    const std::vector<char> found = leavesIn(rows.grow(start, 2, rows.inDomain()), of);
    EXPECT_EQ(found, grown(own, 2, inDomain, of.octree));
  }
}

/// An octree that has some leaves of another one has these as they are, and nothing finer.
TEST(LeafRows, AreLeavesOfAnOctreeThatHasThem)
{
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    const RandomOctree of = randomOctree(seed);
    const LeafRows rows(of.refined, of.frame);
    const MortonKey end = MortonKey{1} << 3 * of.frame.depth;
    const LeafMasks some = rows.grow(rows.in({end / 3, end / 2}), 1, rows.inDomain());
    RefinedSets sets = rows.setsOf(some);
    balance(sets, of.frame, quietContext());
    for (std::size_t level = 0; level < sets.size(); ++level)
    {
      EXPECT_TRUE(std::ranges::includes(of.refined[level], sets[level]));
    }
    const std::vector<char> wanted = leavesIn(some, of);
    const Octree part(of.frame, sets);
    for (Index leaf = 0; leaf < wanted.size(); ++leaf)
    {
      const Octree::Node node = part.nodeAt(of.octree.key(leaf), of.octree.level(leaf));
      EXPECT_TRUE(!wanted[leaf] || (Octree::isLeaf(node) && part.level(Octree::leafOf(node)) == of.octree.level(leaf)));
    }
    EXPECT_EQ(rows.setsOf(rows.in({0, end})), of.refined);
  }
}

TEST(LeafRows, AreCountedByRangeOfKeys)
{
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    const RandomOctree of = randomOctree(seed);
    const LeafRows rows(of.refined, of.frame);
    const OctreeBlocks blocks = findBlocks(of.refined, of.frame, 8 << seed % 4);
    const std::vector<char> inDomain = leavesIn(rows.inDomain(), of);
    std::vector<std::size_t> expected(blocks.count(), 0);
    for (Index leaf = 0; leaf < inDomain.size(); ++leaf)
    {
      expected[blocks.blockOf(of.octree.finestKey(leaf))] += inDomain[leaf] ? 1 : 0;
    }
    EXPECT_EQ(rows.countBetween(blocks.begins, rows.inDomain()), expected);
  }
}

TEST(OctreeBlocks, HaveAllLeavesAndNoMoreThanAsked)
{
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    const RandomOctree of = randomOctree(seed);
    const std::size_t most = 8 << seed % 4;
    const OctreeBlocks blocks = findBlocks(of.refined, of.frame, most);
    EXPECT_EQ(blocks.begins.front(), 0U);
    EXPECT_EQ(blocks.begins.back(), MortonKey{1} << 3 * of.frame.depth);
    std::vector<std::size_t> leaves(blocks.count(), 0);
    for (Index leaf = 0; leaf < of.octree.leafCount(); ++leaf)
    {
      ++leaves[blocks.blockOf(of.octree.finestKey(leaf))];
    }
    for (std::size_t block = 0; block < leaves.size(); ++block)
    {
      EXPECT_GT(leaves[block], 0U);
      EXPECT_LE(leaves[block], most);
    }
    for (const std::size_t ranks : {1U, 2U, 5U})
    {
      const std::vector<Index> firsts = divideBlocks(blocks.leaves, ranks);
      ASSERT_EQ(firsts.size(), ranks + 1);
      EXPECT_EQ(firsts.front(), 0U);
      EXPECT_EQ(firsts.back(), blocks.count());
      for (std::size_t rank = 0; rank < ranks; ++rank)
      {
        EXPECT_TRUE(firsts[rank] < firsts[rank + 1] || blocks.count() < ranks);
      }
    }
  }
}

} // namespace
