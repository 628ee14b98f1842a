// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests boxes of triangles, and pairs of boxes that touch, against a look at all pairs.
#include "BoxSamples.h"
#include "Draw.h"
#include "Support/QuietContext.h"
#include "Surface/Search/BoxPairs.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::areTouching;
using atria::testing::Draw;
using atria::testing::isSame;
using atria::testing::numbered;
using atria::testing::quietContext;

TEST(BoxPairs, BoundsHoldTheLowestAndHighestOfEachAxis)
{
  const auto boxes = numbered({{{0, 5, 2}, {1, 6, 3}}, {{-4, 7, 2}, {-3, 9, 2}}, {{0, 6, -8}, {2, 6, 1}}});
  EXPECT_TRUE(isSame(boundsOf(boxes), {{-4, 5, -8}, {2, 9, 3}}));
  EXPECT_TRUE(isSame(boundsOf(std::vector<NumberedBox>{boxes[1]}), boxes[1]));
}

TEST(BoxPairs, BoxesOfTrianglesHaveTheMarginOnAllSides)
{
  TriangleSoup soup;
  soup.points = {{9, 9, 9}, {1, 20, 3}, {4, 2, 30}, {10, 5, 6}};
  soup.add({1, 2, 3}, 0, 0);
  soup.add({0, 1, 2}, 0, 1);
  const NumberedBox box = boxOf(soup, 0, 2);
  EXPECT_TRUE(isSame(box, {{-1, 0, 1}, {12, 22, 32}}));
  EXPECT_EQ(box.id, 0u);
  EXPECT_TRUE(isSame(boxOf(soup, 1, 0), {{1, 2, 3}, {9, 20, 30}}));
}

TEST(BoxPairs, BoxesAreInTheOrderOfTheTriangles)
{
  Draw draw(1);
  TriangleSoup soup;
  std::vector<Index> some;
  for (Index t = 0; t < 9000; ++t)
  {
    soup.points.insert(soup.points.end(), {draw.point(0, 99), draw.point(0, 99), draw.point(0, 99)});
    soup.add({3 * t, 3 * t + 1, 3 * t + 2}, 0, t);
    some.push_back(static_cast<Index>((t * 7001) % 9000));
  }
  const ThreadExecutor executor(2);
  const std::vector<NumberedBox> boxes = boxesOf(soup, some, 3, quietContext(executor));
  ASSERT_EQ(boxes.size(), some.size());
  for (std::size_t i = 0; i < some.size(); ++i)
  {
    EXPECT_EQ(boxes[i].id, some[i]);
    EXPECT_TRUE(isSame(boxes[i], boxOf(soup, some[i], 3)));
  }
  EXPECT_TRUE(boxesOf(soup, {}, 3, quietContext()).empty());
}

TEST(BoxPairs, AreThoseOfBoxesOfOtherIdsThatTouch)
{
  Draw draw(2);
  for (const std::size_t count : {0u, 1u, 2u, 30u, 90u})
  {
    std::vector<NumberedBox> first;
    std::vector<NumberedBox> second;
    for (std::size_t i = 0; i < count; ++i)
    {
      first.push_back({draw.box(0, 12, 2), static_cast<Index>(draw.in(0, 40))});
      second.push_back({draw.box(0, 12, 2), static_cast<Index>(draw.in(0, 40))});
    }
    std::multiset<std::pair<Index, Index>> expected;
    for (const NumberedBox& a : first)
    {
      for (const NumberedBox& b : second)
      {
        if (a.id != b.id && areTouching(a, b))
        {
          expected.emplace(a.id, b.id);
        }
      }
    }
    std::multiset<std::pair<Index, Index>> found;
    forBoxPairs(first, second, quietContext(), [&](Index a, Index b) { found.emplace(a, b); });
    EXPECT_EQ(found, expected) << count;
  }
}

} // namespace
