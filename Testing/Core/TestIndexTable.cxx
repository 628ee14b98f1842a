// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests tables of indices and small sets of numbers.
#include "Support/FewNumbers.h"
#include "Support/IndexTable.h"
#include "SupportSamples.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <vector>

namespace {

using namespace atria;
using atria::testing::someNumbers;

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

} // namespace
