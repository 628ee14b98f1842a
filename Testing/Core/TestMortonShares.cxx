// SPDX-License-Identifier: GPL-3.0-or-later
#include "Grid/MortonShares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using atria::Index;
using atria::Vec3;

std::vector<Index> divide(const std::vector<Vec3>& places, std::size_t shares, const atria::Executor& executor)
{
  atria::SilentMonitor monitor;
  return atria::divideAlongMorton(places, shares, {executor, atria::ProgressRange(monitor)});
}

std::vector<Vec3> somePlaces(std::size_t count)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-4.0, 9.0);
  std::vector<Vec3> places(count);
  std::ranges::generate(places, [&] { return Vec3(some(random), some(random), some(random)); });
  return places;
}

TEST(MortonShares, AreEquallyLong)
{
  for (const std::size_t shares : {1u, 2u, 3u, 7u, 200u})
  {
    std::vector<std::size_t> counts(shares, 0);
    for (const Index share : divide(somePlaces(100), shares, atria::SerialExecutor()))
    {
      ++counts.at(share);
    }
    EXPECT_LE(std::ranges::max(counts) - std::ranges::min(counts), 1u);
    EXPECT_TRUE(std::ranges::is_sorted(counts, std::greater<>()));
  }
}

TEST(MortonShares, AreOctantsOfACube)
{
  std::vector<Vec3> places;
  for (int i = 0; i < 64; ++i)
  {
    places.emplace_back(i % 4, i / 4 % 4, i / 16);
  }
  const std::vector<Index> shares = divide(places, 8, atria::SerialExecutor());
  for (int i = 0; i < 64; ++i)
  {
    EXPECT_EQ(shares[i], static_cast<Index>(i % 4 / 2 + 2 * (i / 4 % 4 / 2) + 4 * (i / 32)));
  }
}

TEST(MortonShares, AreByNumberWherePlacesAreOne)
{
  const std::vector<Vec3> places(5, Vec3(1, 2, 3));
  EXPECT_EQ(divide(places, 2, atria::SerialExecutor()), (std::vector<Index>{0, 0, 0, 1, 1}));
}

TEST(MortonShares, AreTheSameOnSeveralThreads)
{
  const std::vector<Vec3> places = somePlaces(100000);
  EXPECT_EQ(divide(places, 5, atria::ThreadExecutor(3)), divide(places, 5, atria::SerialExecutor()));
}

TEST(MortonShares, OfNothingAreNone) { EXPECT_TRUE(divide({}, 3, atria::SerialExecutor()).empty()); }

} // namespace
