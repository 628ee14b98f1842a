// SPDX-License-Identifier: GPL-3.0-or-later
/// What is looked for among many boxes, points and edges, against looking at all of them.
#include "Support/QuietContext.h"
#include "Support/Sorting.h"
#include "Surface/Repair/Autorefine.h"
#include "Surface/Repair/SmoothCells.h"
#include "Surface/Search/BoxRaster.h"
#include "Surface/Search/BoxTree.h"
#include "Surface/Triangles/Weld.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

namespace {

using namespace atria;

LatticePoint randomPoint(std::mt19937& random, std::int64_t reach)
{
  std::uniform_int_distribution<std::int64_t> coordinate(-reach, reach);
  return {coordinate(random), coordinate(random), coordinate(random)};
}

/// Of sizes from a point to all there is, some of them long, some the same, some that just touch.
std::vector<NumberedBox> randomBoxes(std::mt19937& random, std::size_t count)
{
  std::uniform_real_distribution<double> part(0.0, 1.0);
  std::vector<NumberedBox> boxes;
  for (Index i = 0; i < count; ++i)
  {
    NumberedBox box{{randomPoint(random, std::int64_t{1} << 38), {}}, i};
    for (int axis = 0; axis < 3; ++axis)
    {
      box.high[axis] = box.low[axis] + (random() % 8 == 0 ? 0 : std::llround(std::exp2(38.0 * part(random))));
    }
    if (i > 0 && random() % 4 == 0)
    {
      const NumberedBox& other = boxes[random() % i];
      box = {{random() % 2 == 0 ? other.low : other.high, other.high}, i};
    }
    boxes.push_back(box);
  }
  return boxes;
}

bool areTouching(const NumberedBox& a, const NumberedBox& b)
{
  bool both = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    both = both && a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis];
  }
  return both;
}

TEST(BoxTree, FindsTheBoxesThatTouch)
{
  std::mt19937 random(1);
  for (const std::size_t count : {1, 7, 8, 9, 64, 65, 700})
  {
    SCOPED_TRACE(count);
    const std::vector<NumberedBox> boxes = randomBoxes(random, count);
    const ThreadExecutor executor(3);
    const BoxTree tree(boxes, atria::testing::quietContext(executor));
    ASSERT_EQ(tree.size(), count);
    for (const NumberedBox& box : boxes)
    {
      for (const std::size_t first : {std::size_t{0}, count / 3, count})
      {
        std::multiset<std::size_t> expected;
        for (std::size_t place = first; place < count; ++place)
        {
          if (areTouching(tree.box(place), box))
          {
            expected.insert(place);
          }
        }
        std::multiset<std::size_t> found;
        tree.eachTouching(box, first, [&](std::size_t place) { found.insert(place); });
        ASSERT_EQ(found, expected);
      }
    }
  }
}

TEST(BoxTree, IsTheSameForAnyThreads)
{
  std::mt19937 random(2);
  const std::vector<NumberedBox> boxes = randomBoxes(random, 60000);
  const ThreadExecutor several(3);
  const BoxTree tree(boxes, atria::testing::quietContext());
  const BoxTree other(boxes, atria::testing::quietContext(several));
  for (std::size_t place = 0; place < boxes.size(); ++place)
  {
    ASSERT_EQ(tree.box(place).id, other.box(place).id);
  }
}

TEST(BoxPairs, AreThoseThatTouchOnceEach)
{
  std::mt19937 random(3);
  const std::vector<NumberedBox> boxes = randomBoxes(random, 300);
  const std::vector<NumberedBox> some(boxes.begin(), boxes.begin() + 100);
  std::multiset<std::pair<Index, Index>> expected;
  for (const NumberedBox& a : some)
  {
    for (const NumberedBox& b : boxes)
    {
      if (a.id != b.id && areTouching(a, b))
      {
        expected.emplace(a.id, b.id);
      }
    }
  }
  std::multiset<std::pair<Index, Index>> found;
  forBoxPairs(some, boxes, atria::testing::quietContext(), [&](Index a, Index b) { found.emplace(a, b); });
  EXPECT_EQ(found, expected);
}

TEST(Weld, PointsBecomeTheFirstOfThoseKeptNearThem)
{
  std::mt19937 random(4);
  for (const std::int64_t distance : {0, 1, 5, 1000})
  {
    SCOPED_TRACE(distance);
    std::vector<LatticePoint> points;
    for (int i = 0; i < 2000; ++i)
    {
      points.push_back(randomPoint(random, 1 + 6 * distance));
    }
    const std::vector<Index> became = weldPoints(points, distance);
    for (Index p = 0; p < points.size(); ++p)
    {
      const auto isNear = [&](Index q) {
        return std::abs(points[p][0] - points[q][0]) <= distance && std::abs(points[p][1] - points[q][1]) <= distance &&
               std::abs(points[p][2] - points[q][2]) <= distance;
      };
      Index expected = p;
      for (Index q = 0; q < p && expected == p; ++q)
      {
        expected = became[q] == q && isNear(q) ? q : p;
      }
      ASSERT_EQ(became[p], expected);
    }
  }
}

TEST(Weld, PointsMayComeLater)
{
  std::mt19937 random(7);
  std::vector<LatticePoint> points;
  PointWelder welder(points, 5);
  std::vector<Index> became;
  for (const std::size_t count : {1, 10, 100, 3000})
  {
    while (points.size() < count)
    {
      points.push_back(randomPoint(random, 40));
    }
    const std::vector<Index> rest = welder.addRest();
    became.insert(became.end(), rest.begin(), rest.end());
    ASSERT_EQ(became, weldPoints(points, 5));
  }
}

TEST(BoxRaster, MissesNoneThatTouchesAndLeavesOutMostOthers)
{
  std::mt19937 random(8);
  const std::int64_t far = std::int64_t{1} << 30;
  std::vector<NumberedBox> boxes;
  for (Index i = 0; i < 200; ++i)
  {
    const LatticePoint low = randomPoint(random, far);
    const std::int64_t size = i % 20 == 0 ? far / 4 : far / 15;
    boxes.push_back({low, {low[0] + size, low[1] + size, low[2] + size}, i});
  }
  const BoxRaster raster(boxes);
  std::size_t found = 0;
  std::size_t touching = 0;
  for (int i = 0; i < 5000; ++i)
  {
    const LatticePoint low = randomPoint(random, far);
    const NumberedBox box{low, {low[0] + far / 100, low[1] + far / 100, low[2] + far / 100}, 0};
    const bool touches = std::ranges::any_of(boxes, [&](const NumberedBox& other) { return areTouching(box, other); });
    EXPECT_TRUE(raster.mayTouch(box) || !touches);
    found += raster.mayTouch(box) ? 1 : 0;
    touching += touches ? 1 : 0;
  }
  EXPECT_GT(touching, 20u);
  EXPECT_LT(found, 4 * touching);
}

/// A wavy sheet of many triangles, with normals about an axis of two.
void addSheet(TriangleSoup& soup, int across, std::int64_t size, std::int64_t at, bool upright)
{
  const auto first = static_cast<Index>(soup.points.size());
  const auto source = static_cast<Index>(soup.triangles.size());
  for (int i = 0; i <= across; ++i)
  {
    for (int j = 0; j <= across; ++j)
    {
      const std::int64_t wave =
          at + std::llround(0.2 * static_cast<double>(size) * std::sin(9.0 * i / across + 0.3 * j / across));
      const LatticePoint p{size * i / across, size * j / across, wave};
      soup.points.push_back(upright ? LatticePoint{p[2], p[1], p[0]} : p);
    }
  }
  const auto row = static_cast<Index>(across + 1);
  Index added = 0;
  for (Index i = 0; i + 1 < row; ++i)
  {
    for (Index j = 0; j + 1 < row; ++j)
    {
      const Index p = first + i * row + j;
      soup.add({p, p + row, p + row + 1}, 0, source + added++);
      soup.add({p, p + row + 1, p + 1}, 0, source + added++);
    }
  }
}

TEST(LoneTriangles, AreMostOfSheetsThatCrossAndChangeNothing)
{
  const std::int64_t size = std::int64_t{1} << 24;
  TriangleSoup soup;
  addSheet(soup, 120, size, size / 2, false);
  addSheet(soup, 90, size, size / 3, true);
  const SerialExecutor executor;
  const RunContext context = atria::testing::quietContext(executor);
  const std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup, executor);
  const SmoothPieces smooth(soup, uses, 30.0, executor);
  const AutorefineOptions options;
  const std::vector<char> isLone = findLoneTriangles(soup, uses, smooth, size / 32, options.reach);
  EXPECT_GT(std::ranges::count(isLone, 1), static_cast<std::ptrdiff_t>(soup.triangles.size() / 2));
  TriangleSoup other = soup;
  ClusterCells none;
  const AutorefineReport all = autorefine(soup, options, none, context);
  const AutorefineReport few = autorefine(other, options, none, context, isLone);
  EXPECT_GT(all.splitTriangles, 100u);
  EXPECT_EQ(few.splitTriangles, all.splitTriangles);
  EXPECT_EQ(other.triangles, soup.triangles);
  EXPECT_EQ(other.points, soup.points);
}

TEST(LoneTriangles, AreNoneOfSheetsSideBySideInACell)
{
  const std::int64_t size = std::int64_t{1} << 24;
  TriangleSoup soup;
  addSheet(soup, 60, size, size / 2, false);
  addSheet(soup, 60, size, size / 2 + size / 1000, false);
  const SerialExecutor executor;
  const std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup, executor);
  const SmoothPieces smooth(soup, uses, 30.0, executor);
  EXPECT_EQ(std::ranges::count(findLoneTriangles(soup, uses, smooth, size / 16, 4), 1), 0);
}

TEST(EdgeUses, AreSortedByEdgeAndTriangle)
{
  std::mt19937 random(5);
  TriangleSoup soup;
  soup.points.resize(50);
  for (Index t = 0; t < 400; ++t)
  {
    soup.add({static_cast<Index>(random() % 50), static_cast<Index>(random() % 50), static_cast<Index>(random() % 50)},
             0, t);
  }
  const std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup, SerialExecutor());
  ASSERT_EQ(uses.size(), 3 * soup.triangles.size());
  std::multiset<std::tuple<EdgeKey, Index, bool>> expected;
  for (Index t = 0; t < soup.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      const EdgeKey edge = edgeKey(soup.triangles[t], i);
      expected.emplace(edge, t, edge.first == soup.triangles[t][i]);
    }
  }
  auto next = expected.begin();
  for (const SoupEdgeUse& use : uses)
  {
    ASSERT_EQ(std::tuple(use.edge, use.triangle, use.forward), *next++);
  }
}

TEST(Sorting, OnThreadsSorts)
{
  std::mt19937 random(6);
  for (const std::size_t count : {0, 1, 16384, 100001})
  {
    for (const int threads : {1, 2, 5})
    {
      const ThreadExecutor executor(threads);
      std::vector<std::uint32_t> list(count);
      std::ranges::generate(list, [&] { return static_cast<std::uint32_t>(random()); });
      std::vector<std::uint32_t> expected = list;
      std::ranges::sort(expected);
      sortOnThreads(list, atria::testing::quietContext(executor));
      ASSERT_EQ(list, expected);
    }
  }
}

} // namespace
