// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests Morton keys, and places that are divided along them.
#include "Grid/Morton.h"
#include "Grid/MortonShares.h"
#include "LatticeSamples.h"
#include "Support/QuietContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Random;

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

MortonKey spreadSlowly(std::uint32_t x)
{
  MortonKey key = 0;
  for (unsigned bit = 0; bit < 21; ++bit)
  {
    key |= static_cast<MortonKey>(x >> bit & 1u) << 3 * bit;
  }
  return key;
}

/// Cells of the finest grid: single bits, all bits, and others.
std::vector<GridCell> someCells()
{
  std::vector<GridCell> cells{{0, 0, 0}, {0x1fffff, 0, 0}, {0, 0x1fffff, 0}, {0, 0, 0x1fffff}};
  for (unsigned bit = 0; bit < 21; ++bit)
  {
    cells.push_back({1u << bit, 0, 0});
    cells.push_back({0, 1u << bit, 0});
    cells.push_back({0x1fffff, 0x1fffff, 1u << bit});
  }
  std::mt19937 random(14);
  for (int i = 0; i < 500; ++i)
  {
    const auto below = [&] { return static_cast<std::uint32_t>(random() & 0x1fffffu); };
    cells.push_back({below(), below(), below()});
  }
  return cells;
}

TEST(MortonKeys, InterleaveTheBitsOfACell)
{
  for (const GridCell& cell : someCells())
  {
    const MortonKey key = mortonKey(cell);
    EXPECT_EQ(spreadBits(cell[0]), spreadSlowly(cell[0]));
    EXPECT_EQ(key, spreadSlowly(cell[0]) | spreadSlowly(cell[1]) << 1 | spreadSlowly(cell[2]) << 2);
    EXPECT_EQ(gridCell(key), cell);
    EXPECT_EQ(gatherBits(key), cell[0]);
    EXPECT_EQ(mortonKey({cell[0] >> 1, cell[1] >> 1, cell[2] >> 1}), key >> 3) << "the parent's";
  }
}

TEST(MortonKeys, LeaveOutBitsBeyondTheTwentyFirst)
{
  EXPECT_EQ(spreadBits(0xffffffffffe00005ull), spreadBits(5));
  EXPECT_EQ(gatherBits(~MortonKey{0}), 0x1fffffu);
  EXPECT_EQ(gatherBits(MortonKey{6}), 0u) << "bits of y and z";
}

/// Sorts by keys in the bounding cube, then by number, and deals out what is left over to the first shares.
std::vector<Index> sharesSlowly(const std::vector<Vec3>& places, std::size_t shares)
{
  Box3 box;
  std::ranges::for_each(places, [&](const Vec3& place) { box.extend(place); });
  std::vector<std::pair<MortonKey, Index>> order;
  for (Index i = 0; i < places.size(); ++i)
  {
    const Vec3 at = (places[i] - box.min) * std::exp2(21.0) / box.size().maxCoeff();
    const auto cellAt = [&](int axis) { return static_cast<std::uint32_t>(std::min(at[axis], 2097151.0)); };
    order.emplace_back(mortonKey({cellAt(0), cellAt(1), cellAt(2)}), i);
  }
  std::ranges::sort(order);
  std::vector<Index> out(places.size());
  std::size_t next = 0;
  for (std::size_t share = 0; share < shares; ++share)
  {
    const std::size_t length = places.size() / shares + (share < places.size() % shares ? 1 : 0);
    for (const std::size_t end = next + length; next < end; ++next)
    {
      out[order[next].second] = static_cast<Index>(share);
    }
  }
  return out;
}

TEST(MortonShares, TellCellsOfTheFinestGridApart)
{
  const double cell = std::exp2(-21.0);
  const std::vector<Vec3> places{{0, 0, 0}, {1, 1, 1}, {0.5 + cell, 0.5, 0.5}, {0.5, 0.5, 0.5}};
  EXPECT_EQ(divideAlongMorton(places, 4, atria::testing::quietContext()), (std::vector<Index>{0, 3, 2, 1}));
}

TEST(MortonShares, AreThoseOfASortByKeys)
{
  Random random(15);
  for (const Vec3& size : {Vec3(8, 8, 8), Vec3(8, 2, 1), Vec3(0, 1, 4), Vec3(1, 8, 0)})
  {
    for (const std::size_t count : {2u, 3u, 11u, 60u})
    {
      std::vector<Vec3> places{Vec3(-3, 5, 7), Vec3(-3, 5, 7) + size};
      while (places.size() < count)
      {
        places.push_back(places[0] + (0.125 * toVector(random.point(0, 8))).cwiseProduct(size));
      }
      for (const std::size_t shares : {1u, 2u, 3u, 7u, 100u})
      {
        EXPECT_EQ(divideAlongMorton(places, shares, atria::testing::quietContext()), sharesSlowly(places, shares));
      }
    }
  }
}

} // namespace
