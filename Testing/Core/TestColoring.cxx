// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the colors of points that may be moved at the same time.
#include "Followers.h"
#include "KernelSamples.h"
#include "Optimize/Kernel/Coloring.h"
#include "Optimize/Kernel/Region.h"
#include "Support/QuietContext.h"
#include "Support/SampleMesh.h"
#include "UpTo.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Followers;
using atria::testing::Loop;
using atria::testing::markSome;
using atria::testing::mixedCells;
using atria::testing::quietContext;
using atria::testing::Sample;
using atria::testing::upTo;

/// True if one of two points writes a cell that the other reads.
bool depend(const Region& region, std::size_t a, std::size_t b)
{
  const auto readBy = [&](std::size_t m) {
    std::set<Index> cells(region.cellsAbout(m).begin(), region.cellsAbout(m).end());
    for (const Index cell : region.cellsAbout(m))
    {
      for (const Index f : region.facesOf(cell))
      {
        cells.insert({region.owner[f], region.neighbor[f]});
      }
    }
    return cells;
  };
  const std::set<Index> read = readBy(a);
  return std::ranges::any_of(region.cellsAbout(b), [&](Index cell) { return read.contains(cell); });
}

/// Gives each point the lowest color that no point before has that depends on it.
std::vector<Loop> naiveColors(const Region& region)
{
  std::vector<Loop> colors;
  for (Index m = 0; m < region.movable.size(); ++m)
  {
    const auto isFree = [&](const Loop& color) {
      return std::ranges::none_of(color,
                                  [&](Index other) { return depend(region, m, other) || depend(region, other, m); });
    };
    const auto found = std::ranges::find_if(colors, isFree);
    (found == colors.end() ? colors.emplace_back() : *found).push_back(m);
  }
  return colors;
}

TEST(Coloring, IsGreedy)
{
  std::mt19937 random(7);
  for (int round = 0; round < 8; ++round)
  {
    SCOPED_TRACE(round);
    const Sample mixed(mixedCells({6, 4, 4}, static_cast<unsigned>(round)));
    Followers followers;
    const std::vector<char> marked = markSome(mixed.mesh.points.size(), random, followers);
    const Region region = extractRegion(mixed.source, marked, followers, false, quietContext());
    const Colors colors = colorPoints(region);
    const std::vector<Loop> expected = naiveColors(region);
    ASSERT_EQ(colors.offsets.size(), expected.size() + 1);
    EXPECT_FALSE(colors.lastIsSerial);
    Loop order;
    for (std::size_t color = 0; color < expected.size(); ++color)
    {
      EXPECT_EQ(colors.offsets[color], order.size());
      order.insert(order.end(), expected[color].begin(), expected[color].end());
      EXPECT_TRUE(colors.isParallel(color));
    }
    EXPECT_EQ(colors.order, order);
    EXPECT_EQ(colors.offsets.back(), order.size());
  }
}

/// Points that all have the same single cell.
Region pointsOfOneCell(std::size_t points)
{
  Region region;
  region.cellOffsets = {0, 0};
  region.movable = upTo(points);
  region.aboutOffsets = upTo(points + 1);
  region.about.assign(points, 0);
  return region;
}

TEST(Coloring, PutsPointsWithoutAFreeColorInASerialOne)
{
  constexpr std::size_t most = 192;
  for (const std::size_t points : {std::size_t{0}, std::size_t{1}, most - 1, most, most + 1, most + 9})
  {
    SCOPED_TRACE(points);
    const Colors colors = colorPoints(pointsOfOneCell(points));
    EXPECT_EQ(colors.order, upTo(points));
    EXPECT_EQ(colors.lastIsSerial, points > most);
    ASSERT_EQ(colors.offsets.size(), std::min(points, most + 1) + 1);
    EXPECT_EQ(colors.offsets.back(), points);
    for (std::size_t color = 0; color + 1 < colors.offsets.size(); ++color)
    {
      EXPECT_EQ(colors.offsets[color], color);
      EXPECT_EQ(colors.isParallel(color), color < most) << color;
    }
  }
}

} // namespace
