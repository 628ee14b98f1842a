// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests searches in trees and rasters of boxes against a look at all boxes.
#include "BoxSamples.h"
#include "Draw.h"
#include "Support/QuietContext.h"
#include "Surface/Search/BoxRaster.h"
#include "Surface/Search/BoxTree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

namespace {

using namespace atria;
using atria::testing::areTouching;
using atria::testing::Draw;
using atria::testing::isSame;
using atria::testing::moved;
using atria::testing::numbered;
using atria::testing::quietContext;

/// Compares searches from each place on with a look at all boxes.
void expectFindsTouching(const BoxTree& tree, const LatticeBox& box, std::size_t first)
{
  std::multiset<std::size_t> expected;
  for (std::size_t place = first; place < tree.size(); ++place)
  {
    if (areTouching(tree.box(place), box))
    {
      expected.insert(place);
    }
  }
  std::multiset<std::size_t> found;
  tree.eachTouching(box, first, [&](std::size_t place) { found.insert(place); });
  EXPECT_EQ(found, expected) << tree.size() << " boxes, from place " << first;
}

TEST(BoxTree, FindsAllFromAPlaceOnForAnyNumberOfBoxes)
{
  Draw draw(3);
  for (std::size_t count = 0; count < 80; ++count)
  {
    const std::int64_t far = draw.in(0, 2) * ((std::int64_t{1} << 39) + 12345);
    std::vector<LatticeBox> boxes(count);
    std::ranges::generate(boxes, [&] { return moved(draw.box(0, 20, draw.in(0, 3) == 0 ? 18 : 3), far); });
    const BoxTree tree(numbered(boxes), quietContext());
    ASSERT_EQ(tree.size(), count);
    for (std::size_t first = 0; first <= count + 1; ++first)
    {
      expectFindsTouching(tree, moved(draw.box(-2, 22, 2), far), first);
    }
    expectFindsTouching(tree, moved({{-1, -1, -1}, {50, 50, 50}}, far), 0);
  }
}

TEST(BoxTree, HoldsEachBoxOnce)
{
  Draw draw(4);
  std::vector<LatticeBox> boxes(600);
  std::ranges::generate(boxes, [&] { return draw.box(-50, 50, std::int64_t{1} << draw.in(0, 20)); });
  const BoxTree tree(numbered(boxes), quietContext());
  std::vector<int> times(boxes.size(), 0);
  for (std::size_t place = 0; place < tree.size(); ++place)
  {
    const NumberedBox& box = tree.box(place);
    EXPECT_TRUE(isSame(box, boxes.at(box.id)));
    ++times[box.id];
  }
  EXPECT_EQ(times, std::vector<int>(boxes.size(), 1));
}

std::vector<Index> orderOf(const std::vector<LatticeBox>& boxes)
{
  const BoxTree tree(numbered(boxes), quietContext());
  std::vector<Index> ids;
  for (std::size_t place = 0; place < tree.size(); ++place)
  {
    ids.push_back(tree.box(place).id);
  }
  return ids;
}

TEST(BoxTree, SortsBySizeInStepsOfFour)
{
  std::vector<LatticeBox> boxes;
  for (const std::int64_t length : {64, 63, 16, 15, 4, 3, 1, 0})
  {
    boxes.push_back({{100, 7, 7}, {100 + length / 2, 7 + length, 7}});
  }
  // Boxes 1 and 2, 3 and 4, 5 and 6 are of one size; centers along y decide.
  EXPECT_EQ(orderOf(boxes), (std::vector<Index>{7, 6, 5, 4, 3, 2, 1, 0}));
}

TEST(BoxTree, SortsBoxesOfOneSizeAlongTheMortonCurveOfTheirCenters)
{
  std::vector<LatticeBox> boxes;
  for (int i = 7; i >= 0; --i)
  {
    const LatticePoint low{4 * (i % 2), 4 * (i / 2 % 2), 4 * (i / 4)};
    boxes.push_back({low, {low[0] + 2, low[1] + 2, low[2] + 2}});
  }
  EXPECT_EQ(orderOf(boxes), (std::vector<Index>{7, 6, 5, 4, 3, 2, 1, 0}));
}

/// The cells of a raster of 64 cells, found by division.
std::set<LatticePoint> cellsOf(const LatticeBox& box, const LatticeBox& bounds, std::int64_t size)
{
  std::set<LatticePoint> cells;
  const auto isIn = [&](int axis, std::int64_t cell) {
    const std::int64_t low = bounds.low[axis] + cell * size;
    const std::int64_t high = std::min(low + size - 1, bounds.high[axis]);
    return low <= bounds.high[axis] && box.low[axis] <= high && box.high[axis] >= low;
  };
  for (std::int64_t x = 0; x < 64; ++x)
  {
    for (std::int64_t y = 0; y < 64 && isIn(0, x); ++y)
    {
      for (std::int64_t z = 0; z < 64 && isIn(1, y); ++z)
      {
        if (isIn(2, z))
        {
          cells.insert({x, y, z});
        }
      }
    }
  }
  return cells;
}

/// The smallest power of two of which 64 hold the longest side.
std::int64_t cellSize(const LatticeBox& bounds)
{
  std::int64_t size = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    while ((bounds.high[axis] - bounds.low[axis]) / size > 63)
    {
      size *= 2;
    }
  }
  return size;
}

TEST(BoxRaster, FindsBoxesWithACommonCell)
{
  Draw draw(5);
  // The longest side is 62, 63, 64, 127 and 128 long: cells double between 63 and 64, and again after 127.
  for (const std::int64_t length : {0, 62, 63, 64, 127, 128, 1000})
  {
    std::vector<NumberedBox> boxes = numbered({{{-7, 3, 5}, {-7, 3, 5}}, {{-7, 3 + length, 5}, {-7, 3 + length, 5}}});
    for (Index i = 2; i < 12; ++i)
    {
      const LatticePoint p{draw.in(-7, -7 + length), draw.in(3, 3 + length), draw.in(5, 5 + length)};
      boxes.push_back({{p, p}, i});
    }
    const LatticeBox bounds = boundsOf(boxes);
    std::set<LatticePoint> taken;
    for (const NumberedBox& box : boxes)
    {
      taken.merge(cellsOf(box, bounds, cellSize(bounds)));
    }
    const BoxRaster raster(boxes);
    for (int i = 0; i < 200; ++i)
    {
      const LatticeBox box = draw.box(-10, 8 + length, i % 2 == 0 ? 1 : length / 8);
      const auto cells = cellsOf(box, bounds, cellSize(bounds));
      const bool isShared = std::ranges::any_of(cells, [&](const LatticePoint& cell) { return taken.contains(cell); });
      EXPECT_EQ(raster.mayTouch(box), isShared && areTouching(box, bounds)) << length;
    }
    for (const NumberedBox& box : boxes)
    {
      EXPECT_TRUE(raster.mayTouch(box)) << length;
    }
  }
}

TEST(BoxRaster, OfOnePointHoldsNoMore)
{
  const BoxRaster raster(numbered({{{5, 6, 7}, {5, 6, 7}}}));
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const std::int64_t offset : {-1, 0, 1})
    {
      LatticePoint p{5, 6, 7};
      p[axis] += offset;
      EXPECT_EQ(raster.mayTouch({p, p}), offset == 0);
    }
  }
}

} // namespace
