// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the lists, tables and numberings of the room Support, and what ranks do with lists.
#include "Support/Buckets.h"
#include "Support/Buffer.h"
#include "Support/Bytes.h"
#include "Support/FewNumbers.h"
#include "Support/GlobalCount.h"
#include "Support/IndexTable.h"
#include "Support/Memory.h"
#include "Support/NumberInOrder.h"
#include "Support/Numbering.h"
#include "Support/Pieces.h"
#include "Support/QuietContext.h"
#include "Support/RankExchange.h"
#include "Support/Sorting.h"
#include "Support/ThreadRanks.h"
#include "Support/UnionFind.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>

namespace {

using namespace atria;
using atria::testing::onRanks;
using atria::testing::quietContext;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::Ge;
using ::testing::IsEmpty;
using Lists = std::vector<std::vector<Index>>;
using Pairs = std::vector<std::pair<Index, Index>>;

/// Runs on one thread, and says that there are several.
class ClaimedThreads : public SerialExecutor
{
public:
  explicit ClaimedThreads(int threads) : claimed(threads) {}
  int threads() const override { return claimed; }
  void forRanges(std::size_t count, std::size_t grain, const Body& body) const override
  {
    mostRanges = std::max(mostRanges, (count + grain - 1) / grain);
    SerialExecutor::forRanges(count, grain, body);
  }

  mutable std::size_t mostRanges = 0;

private:
  int claimed;
};

/// Counts of items around the length of one piece, and of none, one and many pieces.
const std::vector<std::size_t> itemCounts{
    0, 1, Pieces::length - 1, Pieces::length, Pieces::length + 1, 2 * Pieces::length, 5 * Pieces::length + 17};

std::vector<Index> someNumbers(std::size_t count, Index end, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> below(0, end - 1);
  std::vector<Index> numbers(count);
  std::ranges::generate(numbers, [&] { return below(random); });
  return numbers;
}

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

TEST(Buffer, ConstructsWhatHasAConstructor)
{
  Buffer<std::string> texts(2);
  texts.resize(3);
  texts.emplace_back(2, 'x');
  EXPECT_THAT(texts, ElementsAre("", "", "", "xx"));
  EXPECT_THAT(Buffer<int>(3, 7), ElementsAre(7, 7, 7));
}

TEST(Buffer, GivesItsMemoryBack)
{
  Buffer<int> buffer(100, 1);
  release(buffer);
  EXPECT_EQ(buffer.capacity(), 0u);
}

TEST(Memory, ForgetsWholePagesOnly)
{
#ifdef MADV_DONTNEED
  constexpr std::size_t page = std::size_t{1} << 21;
  Buffer<unsigned char> block(4 * page, 1);
  unsigned char* const aligned = block.data() + (page - std::bit_cast<std::uintptr_t>(block.data()) % page) % page;
  const auto forgotten = [](const unsigned char* first, std::size_t count) {
    return static_cast<std::size_t>(std::count(first, first + count, 0));
  };
  EXPECT_EQ(forgetPages(aligned, page - 1), 0u);
  EXPECT_EQ(forgetPages(aligned + 1, 2 * page - 2), 0u) << "no page lies within";
  EXPECT_EQ(forgotten(block.data(), block.size()), 0u);
  EXPECT_EQ(forgetPages(aligned + page - 5, page + 9), page + 5) << "one page, after five bytes";
  EXPECT_EQ(forgotten(aligned + page, page), page);
  EXPECT_EQ(forgotten(block.data(), block.size()), page) << "and no other";
  EXPECT_EQ(forgetPages(aligned, page), page);
  EXPECT_EQ(forgotten(aligned, page), page);
#endif
}

TEST(Memory, InLargePagesIsAlignedAsRequested)
{
  LargePages pages;
  void* const start = pages.allocate(std::size_t{5} << 20, 256);
  EXPECT_EQ(std::bit_cast<std::uintptr_t>(start) % 256, 0u);
  pages.deallocate(start, std::size_t{5} << 20, 256);
  EXPECT_TRUE(pages.is_equal(pages));
  EXPECT_FALSE(pages.is_equal(LargePages()));
}

TEST(Memory, IsReservedWithoutEntries)
{
  std::vector<int> list{4};
  reserveLarge(list, 1000);
  EXPECT_GE(list.capacity(), 1000u);
  EXPECT_THAT(list, ElementsAre(4));
}

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

TEST(FewNumbers, AreDistinctAndHaveALimit)
{
  FewNumbers<3> few;
  for (const Index number : {5u, 5u, 0u, 5u, noIndex, 0u, noIndex})
  {
    EXPECT_TRUE(few.add(number)) << number;
  }
  EXPECT_FALSE(few.add(6));
  EXPECT_FALSE(few.add(6)) << "it was not added";
  EXPECT_TRUE(few.add(5));
  EXPECT_TRUE(few.add(noIndex));
  FewNumbers<1> one;
  EXPECT_TRUE(one.add(0));
  EXPECT_FALSE(one.add(1));
  EXPECT_TRUE(one.add(0));
}

TEST(IndexTable, MixesBitsAsSplitmix64Does)
{
  // The first numbers of splitmix64 from the seed 0.
  constexpr std::uint64_t step = 0x9e3779b97f4a7c15ull;
  EXPECT_EQ(mixed(0), 0u);
  EXPECT_EQ(mixed(step), 0xe220a8397b1dcdafull);
  EXPECT_EQ(mixed(2 * step), 0x6e789e6aa1b965f4ull);
  EXPECT_EQ(mixed(3 * step), 0x06c45d188009454full);
}

TEST(IndexTable, FindsTheFirstOfEqualThingsWhateverTheHash)
{
  const std::vector<Index> things = someNumbers(600, 250);
  const std::size_t distinct = std::set<Index>(things.begin(), things.end()).size();
  const std::vector<std::uint64_t (*)(Index)> hashes{
      [](Index thing) { return mixed(thing); }, [](Index) { return std::uint64_t{0}; },
      [](Index) { return ~std::uint64_t{0}; }, [](Index thing) { return std::uint64_t{thing % 3} << 32; },
      [](Index thing) { return std::uint64_t{thing % 7}; }};
  for (const auto hash : hashes)
  {
    IndexTable table(distinct);
    std::map<Index, Index> firsts;
    for (Index i = 0; i < things.size(); ++i)
    {
      const Index wanted = firsts.emplace(things[i], i).first->second;
      EXPECT_EQ(table.findOrAdd(hash(things[i]), i, [&](Index other) { return things[other] == things[i]; }), wanted);
    }
  }
}

TEST(IndexTable, ComparesOnlyWhatHasTheSameHighBits)
{
  IndexTable table(10);
  for (Index i = 0; i < 10; ++i)
  {
    const std::uint64_t hash = (std::uint64_t{i} << 32) + 3;
    const auto isNeverAsked = [](Index) {
      ADD_FAILURE() << "compared";
      return false;
    };
    EXPECT_EQ(table.findOrAdd(hash, i, isNeverAsked), i);
  }
  EXPECT_EQ(table.findOrAdd((std::uint64_t{7} << 32) + 3, 99, [](Index other) { return other == 7; }), 7u);
}

TEST(IndexTable, HoldsAsManyAsExpected)
{
  for (Index expected = 0; expected < 40; ++expected)
  {
    IndexTable table(expected);
    for (Index i = 0; i < expected; ++i)
    {
      EXPECT_EQ(table.findOrAdd(i, i, [](Index) { return false; }), i);
    }
  }
}

std::vector<Numbering> numberingsBelow(std::size_t end)
{
  return {Numbering(0),      Numbering(end),      Numbering(0, end),
          Numbering(3, end), Numbering(end, end), Numbering(1, 100000)};
}

TEST(Numbering, GivesConsecutiveNumbersAndListsTheIdentities)
{
  constexpr Index end = 3000;
  for (Numbering& numbering : numberingsBelow(end))
  {
    std::vector<Index> list;
    std::map<Index, Index> wanted;
    for (const Index id : someNumbers(4000, end))
    {
      const auto [at, isNew] = wanted.emplace(id, static_cast<Index>(wanted.size()));
      ASSERT_EQ(numbering.findOrAdd(id, list), at->second);
      ASSERT_EQ(list.size(), wanted.size());
      ASSERT_EQ(list[at->second], id);
    }
    for (Index id = 0; id < end; ++id)
    {
      EXPECT_EQ(numbering.of(id), wanted.contains(id) ? wanted[id] : noIndex);
    }
  }
}

TEST(Numbering, KnowsTheNumbersThatAreSet)
{
  for (Numbering numbering : {Numbering(200), Numbering(200, 400), Numbering(200, 100000)})
  {
    for (Index id = 1; id < 400; id += 2)
    {
      numbering.add(id, 1000 - id);
    }
    for (Index id = 0; id < 400; ++id)
    {
      EXPECT_EQ(numbering.of(id), id % 2 == 1 ? 1000 - id : noIndex);
    }
  }
}

TEST(Numbering, OfIdentitiesFarApartIsTheSame)
{
  Numbering numbering(2);
  std::vector<Index> list;
  const std::vector<Index> ids{noIndex - 1, 0, 1u << 31, 1u << 16, (1u << 31) + (1u << 16), 65535};
  for (Index i = 0; i < ids.size(); ++i)
  {
    EXPECT_EQ(numbering.findOrAdd(ids[i], list), i);
  }
  EXPECT_EQ(list, ids);
}

void expectKept(const std::vector<char>& stays)
{
  std::vector<Index> list(stays.size());
  std::iota(list.begin(), list.end(), Index{0});
  std::vector<Index> wantedList;
  std::vector<Index> wantedNumbers;
  for (const Index i : list)
  {
    wantedNumbers.push_back(stays[i] == 0 ? noIndex : static_cast<Index>(wantedList.size()));
    wantedList.insert(wantedList.end(), stays[i] == 0 ? 0 : 1, i);
  }
  const std::vector<Index> numbers = numbersOfKept(stays);
  EXPECT_EQ(numbers, wantedNumbers);
  compact(list, numbers);
  EXPECT_EQ(list, wantedList);
}

TEST(KeptEntries, AreNumberedAndMovedInOrder)
{
  for (unsigned bits = 0; bits < 32; ++bits)
  {
    const auto isSet = [&](unsigned i) { return static_cast<char>(bits >> i & 1u); };
    expectKept({isSet(0), isSet(1), isSet(2), isSet(3), isSet(4)});
  }
  expectKept({});
}

TEST(KeptEntries, OfAShorterListAreThoseItHas)
{
  std::vector<std::string> list{"a", "b", "c"};
  compact(list, numbersOfKept({1, 0, 1, 1, 0}));
  EXPECT_THAT(list, ElementsAre("a", "c"));
}

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

TEST(SortOnThreads, GivesTheOrderOfOneSort)
{
  for (const std::size_t count : {0u, 1u, 2u, 16384u, 16385u, 32770u, 50001u})
  {
    const std::vector<Index> given = someNumbers(count, 20000);
    std::vector<Index> wanted = given;
    std::ranges::sort(wanted);
    for (const int threads : {1, 2, 5, 1000})
    {
      std::vector<Index> list = given;
      const ClaimedThreads executor(threads);
      sortOnThreads(list, quietContext(executor));
      EXPECT_EQ(list, wanted) << count << " on " << threads;
    }
  }
}

TEST(SortOnThreads, SortsByTheGivenComparison)
{
  std::vector<Index> list = someNumbers(40000, 1000000);
  std::vector<Index> wanted = list;
  std::ranges::sort(wanted, std::greater<>());
  const ThreadExecutor threads(3);
  sortOnThreads(list, quietContext(threads), std::greater<>());
  EXPECT_EQ(list, wanted);
}

TEST(SortOnThreads, GivesEachThreadAPiece)
{
  for (const int threads : {1, 2, 4, 6})
  {
    std::vector<Index> list = someNumbers(200000, 100);
    const ClaimedThreads executor(threads);
    sortOnThreads(list, quietContext(executor));
    EXPECT_GE(executor.mostRanges, static_cast<std::size_t>(threads));
  }
}

/// Says that the user wants to stop, after `patience` questions.
class Impatient : public SilentMonitor
{
public:
  explicit Impatient(int patience) : left(patience) {}
  bool aborted() const override { return left-- <= 0; }

private:
  mutable int left;
};

TEST(SortOnThreads, EndsWhenTheUserAborts)
{
  for (const int patience : {0, 1})
  {
    Impatient monitor(patience);
    const ClaimedThreads executor(2);
    std::vector<Index> list = someNumbers(40000, 100);
    EXPECT_THROW(sortOnThreads(list, {executor, ProgressRange(monitor)}), Aborted) << "after " << patience;
  }
}

TEST(UniqueLists, AreSortedAndMerged)
{
  for (const std::size_t count : {0u, 1u, 2u, 50u})
  {
    for (const std::size_t more : {0u, 1u, 50u})
    {
      std::vector<Index> a = someNumbers(count, 40, 3);
      std::vector<Index> b = someNumbers(more, 40, 4);
      std::set<Index> wanted(a.begin(), a.end());
      sortUnique(a);
      EXPECT_THAT(a, ElementsAreArray(wanted));
      wanted.insert(b.begin(), b.end());
      sortUnique(b);
      mergeUnique(a, b);
      EXPECT_THAT(a, ElementsAreArray(wanted));
    }
  }
}

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
