// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests values as bytes, and what ranks do with lists.
#include "Support/Bytes.h"
#include "Support/GlobalCount.h"
#include "Support/RankExchange.h"
#include "Support/ThreadRanks.h"
#include "Support/Types.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace atria;
using atria::testing::onRanks;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using Lists = std::vector<std::vector<Index>>;

struct Record
{
  Index number;
  std::array<char, 3> letters;
  bool operator==(const Record&) const = default;
};

TEST(Bytes, AreReadBackInTheirOrder)
{
  const Bytes bytes = bytesOf(7, std::vector<double>{1.5, -2.0}, std::string("ab"), std::vector<Index>(),
                              Record{9, {'x', 'y', 'z'}}, Vec3(1, 2, 3), std::vector<Vec3>{{4, 5, 6}, {7, 8, 9}}, 'q');
  int first = 0;
  std::vector<double> values(5, 8.0);
  std::string text = "longer than before";
  std::vector<Index> none{1, 2};
  Record record{};
  Vec3 place = Vec3::Zero();
  std::vector<Vec3> places;
  char last = ' ';
  readBytes(bytes, first, values, text, none, record, place, places, last);
  EXPECT_EQ(first, 7);
  EXPECT_THAT(values, ElementsAre(1.5, -2.0));
  EXPECT_EQ(text, "ab");
  EXPECT_THAT(none, IsEmpty());
  EXPECT_EQ(record, (Record{9, {'x', 'y', 'z'}}));
  EXPECT_EQ(place, Vec3(1, 2, 3));
  EXPECT_THAT(places, ElementsAre(Vec3(4, 5, 6), Vec3(7, 8, 9)));
  EXPECT_EQ(last, 'q');
}

TEST(Bytes, AreNoMoreThanTheValuesAndTheLengthsOfLists)
{
  EXPECT_EQ(bytesOf().size(), 0u);
  EXPECT_EQ(bytesOf(std::uint16_t{1}, 2.0).size(), 10u);
  EXPECT_EQ(bytesOf(std::vector<std::uint16_t>{1, 2, 3}).size(), sizeof(std::size_t) + 6u);
  EXPECT_EQ(bytesOf(std::string()).size(), sizeof(std::size_t));
}

/// A list of rank `from` for rank `to`: its length and its entries are different for each pair.
std::vector<Index> letter(std::size_t from, std::size_t to)
{
  std::vector<Index> list(from + 2 * to);
  std::iota(list.begin(), list.end(), static_cast<Index>(100 * from + 10 * to));
  return list;
}

TEST(Ranks, ReceiveTheListThatIsForThem)
{
  onRanks(3, [](RankExchange& ranks) {
    const auto own = static_cast<std::size_t>(ranks.rank());
    const Lists received = exchangeLists(ranks, Lists{letter(own, 0), letter(own, 1), letter(own, 2)});
    EXPECT_EQ(received, (Lists{letter(0, own), letter(1, own), letter(2, own)}));
  });
  EXPECT_EQ(exchangeLists(alone(), Lists{{5, 6}}), (Lists{{5, 6}}));
}

class RanksTogether : public ::testing::TestWithParam<int>
{
protected:
  /// Runs a check on each rank with the number of this rank and of all.
  static void onEach(const std::function<void(RankExchange&, std::size_t own, std::size_t all)>& check)
  {
    onRanks(GetParam(), [&](RankExchange& ranks) {
      check(ranks, static_cast<std::size_t>(ranks.rank()), static_cast<std::size_t>(ranks.ranks()));
    });
  }
};

TEST_P(RanksTogether, GatherTheirValuesInOrder)
{
  onEach([](RankExchange& ranks, std::size_t own, std::size_t all) {
    std::vector<std::size_t> squares;
    std::vector<Index> joined;
    for (std::size_t rank = 0; rank < all; ++rank)
    {
      squares.push_back(rank * rank);
      joined.insert(joined.end(), rank, static_cast<Index>(rank));
    }
    EXPECT_EQ(gatherAll(ranks, own * own), squares);
    EXPECT_EQ(joinAll(ranks, std::vector<Index>(own, static_cast<Index>(own))), joined);
  });
}

TEST_P(RanksTogether, AddUpTheirLists)
{
  onEach([](RankExchange& ranks, std::size_t own, std::size_t all) {
    const std::size_t sum = all * (all - 1) / 2;
    EXPECT_THAT(sumAll(ranks, std::vector<std::size_t>{own, 1, 0}), ElementsAre(sum, all, 0u));
    EXPECT_THAT(sumAll(ranks, std::vector<std::size_t>()), IsEmpty());
    const auto most = [](std::size_t more, std::size_t& so) { so = std::max(so, more); };
    EXPECT_THAT(addAll(ranks, std::vector<std::size_t>{own, 7}, most), ElementsAre(all - 1, 7u));
  });
}

TEST_P(RanksTogether, FindWhatIsSetOnAny)
{
  onEach([](RankExchange& ranks, std::size_t own, std::size_t all) {
    const std::vector<char> set{0, 1, static_cast<char>(own == 0), static_cast<char>(own + 1 == all)};
    EXPECT_THAT(anyOfAll(ranks, set), ElementsAre(0, 1, 1, 1));
    EXPECT_FALSE(isAnywhere(false, ranks));
    for (std::size_t rank = 0; rank < all; ++rank)
    {
      EXPECT_TRUE(isAnywhere(own == rank, ranks));
    }
  });
}

TEST_P(RanksTogether, CountWhatTheRanksBeforeHave)
{
  onEach([](RankExchange& ranks, std::size_t own, std::size_t all) {
    const GlobalCount count = countBefore(3 * own + 2, ranks);
    std::size_t before = 0;
    for (std::size_t rank = 0; rank < own; ++rank)
    {
      before += 3 * rank + 2;
    }
    EXPECT_EQ(count.before, before);
    EXPECT_EQ(count.all, 3 * all * (all - 1) / 2 + 2 * all);
  });
}

INSTANTIATE_TEST_SUITE_P(Numbers, RanksTogether, ::testing::Values(1, 2, 5));

TEST(SoleRank, HasAllToItself)
{
  EXPECT_EQ(alone().rank(), 0);
  EXPECT_EQ(alone().ranks(), 1);
  EXPECT_EQ(alone().gather(bytesOf(Index{4})), std::vector<Bytes>{bytesOf(Index{4})});
  bool isDone = false;
  EXPECT_TRUE(alone().agreeOn([&] { isDone = true; }));
  EXPECT_TRUE(isDone);
  EXPECT_EQ(countBefore(6, alone()).before, 0u);
  EXPECT_EQ(countBefore(6, alone()).all, 6u);
}

} // namespace
