// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests lists in buckets.
#include "Support/Buckets.h"
#include "Support/Pieces.h"
#include "SupportSamples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::ClaimedThreads;
using atria::testing::someNumbers;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Lists = std::vector<std::vector<Index>>;
using Pairs = std::vector<std::pair<Index, Index>>;

/// Rising entries in any buckets.
Pairs somePairs(std::size_t buckets, std::size_t count)
{
  Pairs pairs;
  const std::vector<Index> bucketOf = someNumbers(count, static_cast<Index>(buckets));
  for (std::size_t i = 0; i < count; ++i)
  {
    pairs.emplace_back(bucketOf[i], static_cast<Index>(3 * i));
  }
  return pairs;
}

Lists listsOf(std::size_t buckets, const Pairs& pairs)
{
  Lists lists(buckets);
  for (const auto& [bucket, entry] : pairs)
  {
    lists[bucket].push_back(entry);
  }
  return lists;
}

Lists listsOf(const Buckets& buckets)
{
  Lists lists;
  for (std::size_t i = 0; i + 1 < buckets.offsets.size(); ++i)
  {
    lists.emplace_back(buckets.of(i).begin(), buckets.of(i).end());
  }
  return lists;
}

auto eachOf(const Pairs& pairs, const Executor& executor)
{
  return [&](auto&& use) {
    executor.forEach(pairs.size(), 100, [&](std::size_t i) { use(pairs[i].first, pairs[i].second); });
  };
}

TEST(Buckets, HoldTheEntriesInTheOrderOfTheCallsOnOneThread)
{
  const SerialExecutor serial;
  for (const std::size_t buckets : {1u, 2u, 7u, 300u, 70000u})
  {
    for (const std::size_t count : {0u, 1u, 5u, 4000u})
    {
      Pairs pairs = somePairs(buckets, count);
      std::ranges::reverse(pairs);
      EXPECT_EQ(listsOf(fillBuckets(buckets, serial, eachOf(pairs, serial))), listsOf(buckets, pairs));
    }
  }
}

TEST(Buckets, HoldTheEntriesInRisingOrderOnSeveralThreads)
{
  const Pairs pairs = somePairs(50, 30000);
  const ThreadExecutor threads(3);
  EXPECT_EQ(listsOf(fillInOrder(50, threads, eachOf(pairs, threads))), listsOf(50, pairs));

  Pairs falling = somePairs(5000, 20000);
  const Lists wanted = listsOf(5000, falling);
  std::ranges::reverse(falling);
  const ClaimedThreads claimed(2);
  EXPECT_EQ(listsOf(fillInOrder(5000, claimed, eachOf(falling, claimed))), wanted);
}

TEST(Buckets, OnOneThreadKeepWhatIsInOrder)
{
  const Pairs pairs = somePairs(40, 500);
  const SerialExecutor serial;
  EXPECT_EQ(listsOf(fillInOrder(40, serial, eachOf(pairs, serial))), listsOf(40, pairs));
}

TEST(Buckets, ThatAreNoneHaveOneOffset)
{
  const SerialExecutor serial;
  const Buckets none = fillBuckets(0, serial, [](auto&&) {});
  EXPECT_THAT(none.offsets, ElementsAre(0u));
  EXPECT_THAT(none.entries, IsEmpty());
}

} // namespace
