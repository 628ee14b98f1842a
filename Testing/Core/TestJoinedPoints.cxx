// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests sets of joined points against a flood.
#include "Dual/Grid/JoinedPoints.h"
#include "Support/QuietContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

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

} // namespace
