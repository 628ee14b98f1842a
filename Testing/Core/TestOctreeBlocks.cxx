// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests blocks of octants, and how they are divided among ranks.
#include "Octree/Tree/OctreeBlocks.h"
#include "SizingFrame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

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
