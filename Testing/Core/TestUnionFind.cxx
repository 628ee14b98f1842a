// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sets that are joined.
#include "Support/Executor.h"
#include "Support/UnionFind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace {

using namespace atria;

/// Joins by renaming all members of one set: O(n) per join.
void joinSlowly(std::vector<Index>& rootOf, Index a, Index b)
{
  const Index low = std::min(rootOf[a], rootOf[b]);
  const Index high = std::max(rootOf[a], rootOf[b]);
  std::ranges::replace(rootOf, high, low);
}

TEST(UnionFind, FindsTheSmallestMemberOfASet)
{
  std::mt19937 random(5);
  constexpr Index count = 60;
  for (int round = 0; round < 50; ++round)
  {
    UnionFind sets(count);
    std::vector<Index> wanted(count);
    std::iota(wanted.begin(), wanted.end(), Index{0});
    for (int join = 0; join < 2 * round; ++join)
    {
      const auto a = static_cast<Index>(random() % count);
      const auto b = static_cast<Index>(random() % count);
      sets.join(a, b);
      joinSlowly(wanted, a, b);
    }
    for (Index i = 0; i < count; ++i)
    {
      EXPECT_EQ(sets.find(i), wanted[i]);
      EXPECT_EQ(sets.find(i), wanted[i]) << "after the way to the root was made shorter";
    }
  }
}

TEST(UnionFind, FindsOnSeveralThreads)
{
  constexpr Index count = 20000;
  UnionFind sets(count);
  for (Index i = count - 1; i >= 2; --i)
  {
    sets.join(i, i - 2); // long chains
  }
  std::vector<char> isWrong(count, 0);
  ThreadExecutor(3).forEach(count, 64, [&](std::size_t i) {
    const auto last = static_cast<Index>(count - 1 - i);
    isWrong[i] = sets.find(last) == last % 2 ? 0 : 1;
  });
  EXPECT_EQ(std::ranges::count(isWrong, 1), 0);
}

TEST(UnionFind, StartsAnewAfterReset)
{
  UnionFind sets(3);
  sets.join(0, 2);
  sets.reset(5);
  for (Index i = 0; i < 5; ++i)
  {
    EXPECT_EQ(sets.find(i), i);
  }
  sets.join(4, 3);
  EXPECT_EQ(sets.find(4), 3u);
}

} // namespace
