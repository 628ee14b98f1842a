// SPDX-License-Identifier: GPL-3.0-or-later
/// What is looked for among many boxes, points and edges, against looking at all of them.
#include "Support/Sorting.h"
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
    NumberedBox box{randomPoint(random, std::int64_t{1} << 38), {}, i};
    for (int axis = 0; axis < 3; ++axis)
    {
      box.high[axis] = box.low[axis] + (random() % 8 == 0 ? 0 : std::llround(std::exp2(38.0 * part(random))));
    }
    if (i > 0 && random() % 4 == 0)
    {
      const NumberedBox& other = boxes[random() % i];
      box = {random() % 2 == 0 ? other.low : other.high, other.high, i};
    }
    boxes.push_back(box);
  }
  return boxes;
}

bool touch(const NumberedBox& a, const NumberedBox& b)
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
  SilentMonitor silent;
  for (const std::size_t count : {1, 7, 8, 9, 64, 65, 700})
  {
    SCOPED_TRACE(count);
    const std::vector<NumberedBox> boxes = randomBoxes(random, count);
    const ThreadExecutor executor(3);
    const BoxTree tree(boxes, {executor, ProgressRange(silent)});
    ASSERT_EQ(tree.size(), count);
    for (const NumberedBox& box : boxes)
    {
      for (const std::size_t first : {std::size_t{0}, count / 3, count})
      {
        std::multiset<std::size_t> expected;
        for (std::size_t place = first; place < count; ++place)
        {
          if (touch(tree.box(place), box))
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
  SilentMonitor silent;
  const std::vector<NumberedBox> boxes = randomBoxes(random, 60000);
  const SerialExecutor one;
  const ThreadExecutor several(3);
  const BoxTree tree(boxes, {one, ProgressRange(silent)});
  const BoxTree other(boxes, {several, ProgressRange(silent)});
  for (std::size_t place = 0; place < boxes.size(); ++place)
  {
    ASSERT_EQ(tree.box(place).id, other.box(place).id);
  }
}

TEST(BoxPairs, AreThoseThatTouchOnceEach)
{
  std::mt19937 random(3);
  const SerialExecutor executor;
  SilentMonitor silent;
  const std::vector<NumberedBox> boxes = randomBoxes(random, 300);
  const std::vector<NumberedBox> some(boxes.begin(), boxes.begin() + 100);
  std::multiset<std::pair<Index, Index>> expected;
  for (const NumberedBox& a : some)
  {
    for (const NumberedBox& b : boxes)
    {
      if (a.id != b.id && touch(a, b))
      {
        expected.emplace(a.id, b.id);
      }
    }
  }
  std::multiset<std::pair<Index, Index>> found;
  forBoxPairs(some, boxes, {executor, ProgressRange(silent)}, [&](Index a, Index b) { found.emplace(a, b); });
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
  SilentMonitor silent;
  for (const std::size_t count : {0, 1, 16384, 100001})
  {
    for (const int threads : {1, 2, 5})
    {
      const ThreadExecutor executor(threads);
      std::vector<std::uint32_t> list(count);
      std::ranges::generate(list, [&] { return static_cast<std::uint32_t>(random()); });
      std::vector<std::uint32_t> expected = list;
      std::ranges::sort(expected);
      sortOnThreads(list, {executor, ProgressRange(silent)});
      ASSERT_EQ(list, expected);
    }
  }
}

} // namespace
