// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests numberings, and entries that are kept.
#include "Support/Numbering.h"
#include "SupportSamples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <string>
#include <vector>

namespace {

using namespace atria;
using atria::testing::someNumbers;
using ::testing::ElementsAre;

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

} // namespace
