// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests pieces of items, and what is counted, collected and noted in their order.
#include "Support/Error.h"
#include "Support/NumberInOrder.h"
#include "Support/Pieces.h"
#include "SupportSamples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::someNumbers;
using ::testing::ElementsAre;

/// Counts of items around the length of one piece, and of none, one and many pieces.
const std::vector<std::size_t> itemCounts{
    0, 1, Pieces::length - 1, Pieces::length, Pieces::length + 1, 2 * Pieces::length, 5 * Pieces::length + 17};

TEST(Pieces, CoverAllItemsInTheirOrder)
{
  for (const std::size_t items : itemCounts)
  {
    const Pieces pieces(items);
    std::size_t covered = 0;
    for (std::size_t piece = 0; piece < pieces.count; ++piece)
    {
      EXPECT_EQ(pieces.begin(piece), covered);
      EXPECT_GT(pieces.end(piece), covered);
      EXPECT_LE(pieces.end(piece) - covered, Pieces::length);
      covered = pieces.end(piece);
    }
    EXPECT_EQ(covered, items);
  }
}

TEST(Scan, TurnsCountsIntoOffsets)
{
  std::vector<int> none;
  EXPECT_EQ(scan(none), 0);
  std::vector<std::size_t> counts{3, 0, 5, 1};
  EXPECT_EQ(scan(counts), 9u);
  EXPECT_THAT(counts, ElementsAre(0u, 3u, 3u, 8u));
}

TEST(CollectInOrder, AppendsWhatThePiecesFind)
{
  const auto repeat = [](std::size_t begin, std::size_t end, std::vector<Index>& out) {
    for (std::size_t i = begin; i < end; ++i)
    {
      out.insert(out.end(), i % 3, static_cast<Index>(i)); // none, one or two
    }
  };
  for (const std::size_t count : itemCounts)
  {
    std::vector<Index> wanted;
    repeat(0, count, wanted);
    EXPECT_EQ(collectInOrder(count, SerialExecutor(), repeat), wanted);
    EXPECT_EQ(collectInOrder(count, ThreadExecutor(3), repeat), wanted);
  }
}

TEST(ChosenNumbers, AreThoseForWhichTheConditionHolds)
{
  for (const std::size_t count : itemCounts)
  {
    const std::vector<Index> kinds = someNumbers(count, 3);
    std::vector<Index> wanted;
    for (Index i = 0; i < count; ++i)
    {
      wanted.insert(wanted.end(), kinds[i] == 1 ? 1 : 0, i);
    }
    EXPECT_EQ(chosenNumbers(count, ThreadExecutor(3), [&](std::size_t i) { return kinds[i] == 1; }), wanted);
  }
}

TEST(NumberInOrder, CountsTheChosenItems)
{
  for (const std::size_t count : itemCounts)
  {
    const std::vector<Index> kinds = someNumbers(count, 3);
    std::vector<Index> wanted;
    Index next = 0;
    for (const Index kind : kinds)
    {
      wanted.push_back(kind == 1 ? next++ : noIndex);
    }
    std::vector<Index> numbers(count, 77);
    EXPECT_EQ(numberInOrder(numbers, ThreadExecutor(3), [&](std::size_t i) { return kinds[i] == 1; }), next);
    EXPECT_EQ(numbers, wanted);
  }
}

std::string errorAfter(const std::vector<std::pair<std::size_t, std::string>>& notes)
{
  FirstError error;
  for (const auto& [place, what] : notes)
  {
    error.note(place, what);
  }
  try
  {
    error.rethrow();
  }
  catch (const Error& thrown)
  {
    return thrown.what();
  }
  return "none";
}

TEST(FirstError, IsTheOneAtTheSmallestPlace)
{
  EXPECT_EQ(errorAfter({}), "none");
  EXPECT_EQ(errorAfter({{8, "late"}}), "late");
  EXPECT_EQ(errorAfter({{8, "late"}, {0, "first"}, {3, "second"}}), "first");
  EXPECT_EQ(errorAfter({{2, "one"}, {2, "other"}}), "one") << "that was noted first";
}

TEST(FirstError, IsTheSameOnSeveralThreads)
{
  FirstError error;
  ThreadExecutor(3).forEach(1000, 1, [&](std::size_t i) { error.note(1000 - i, std::to_string(1000 - i)); });
  EXPECT_THAT([&] { error.rethrow(); }, ::testing::ThrowsMessage<Error>("1"));
}

} // namespace
