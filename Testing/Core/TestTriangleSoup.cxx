// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests triangles on the lattice and the uses of their edges.
#include "Draw.h"
#include "SoupSamples.h"
#include "Support/Executor.h"
#include "Surface/Triangles/EachEdge.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <span>
#include <vector>

namespace {

using namespace atria;
using atria::testing::asTuples;
using atria::testing::Draw;
using atria::testing::naiveUses;
using atria::testing::Triangle;
using atria::testing::Use;
using ::testing::ElementsAre;

TEST(TriangleSoup, KnowsCornersAndKeepsWhatWasAdded)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  soup.add({3, 1, 0}, 7, 4);
  soup.add({0, 1, 2}, 8, 5);
  EXPECT_EQ(soup.corner(0, 0), (LatticePoint{0, 0, 3}));
  EXPECT_EQ(soup.corner(0, 2), (LatticePoint{0, 0, 0}));
  EXPECT_EQ(soup.corner(1, 2), (LatticePoint{0, 2, 0}));
  EXPECT_THAT(soup.surfaceIds, ElementsAre(7, 8));
  EXPECT_THAT(soup.sources, ElementsAre(4, 5));
}

TEST(TriangleSoup, EdgesHaveTheLowerPointFirst)
{
  EXPECT_EQ(edgeKey(3, 5), EdgeKey(3, 5));
  EXPECT_EQ(edgeKey(5, 3), EdgeKey(3, 5));
  const Triangle t{9, 4, 6};
  EXPECT_EQ(edgeKey(t, 0), EdgeKey(4, 9));
  EXPECT_EQ(edgeKey(t, 1), EdgeKey(4, 6));
  EXPECT_EQ(edgeKey(t, 2), EdgeKey(6, 9));
}

TEST(TriangleSoup, FindsPointsInTriangles)
{
  const Triangle t{9, 4, 6};
  for (Index p = 0; p < 12; ++p)
  {
    EXPECT_EQ(contains(t, p), p == 9 || p == 4 || p == 6);
  }
  EXPECT_FALSE(hasRepeatedPoint(t));
  for (const Triangle& repeated : {Triangle{1, 1, 2}, Triangle{1, 2, 2}, Triangle{1, 2, 1}, Triangle{1, 1, 1}})
  {
    EXPECT_TRUE(hasRepeatedPoint(repeated));
  }
}

TEST(TriangleSoup, VectorsLeadFromTheFirstPointToTheSecond)
{
  const std::int64_t far = std::int64_t{1} << 40;
  EXPECT_EQ(between({1, 2, 3}, {5, 0, 3}), Vec3(4, -2, 0));
  EXPECT_EQ(between({far, -far, far}, {far + 1, 1 - far, -far}), Vec3(1, 1, -2.0 * static_cast<double>(far)));
}

TEST(TriangleSoup, ListsTheTrianglesAtEachPoint)
{
  Draw draw(1);
  TriangleSoup soup = draw.soup(20, 60);
  soup.points.resize(22); // the last two are unused
  const Buckets at = trianglesAtPoints(soup);
  for (Index p = 0; p < soup.points.size(); ++p)
  {
    std::vector<Index> expected;
    for (Index t = 0; t < soup.triangles.size(); ++t)
    {
      if (contains(soup.triangles[t], p))
      {
        expected.push_back(t);
      }
    }
    EXPECT_TRUE(std::ranges::equal(at.of(p), expected)) << p;
  }
}

TEST(EdgeUses, AreSortedByEdgeAndTriangleOnAnyThreads)
{
  Draw draw(2);
  const SerialExecutor serial;
  const ThreadExecutor several(3);
  for (const std::size_t count : {0u, 1u, 2u, 50u, 5000u})
  {
    const TriangleSoup soup = draw.soup(count + 3, count);
    const std::vector<Use> expected = naiveUses(soup.triangles);
    EXPECT_EQ(asTuples(sortedEdgeUses(soup, serial)), expected);
    EXPECT_EQ(asTuples(sortedEdgeUses(soup, several)), expected);
    EXPECT_EQ(asTuples(sortedEdgeUses(soup.triangles, soup.points.size(), serial)), expected);
  }
}

TEST(EachEdge, GetsAllUsesOfAnEdgeAtOnce)
{
  Draw draw(3);
  for (const std::size_t count : {0u, 1u, 2u, 3u, 100u})
  {
    const TriangleSoup soup = draw.soup(8, count);
    const std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup, SerialExecutor());
    std::map<EdgeKey, std::size_t> counts;
    for (const auto& t : soup.triangles)
    {
      ++counts[edgeKey(t, 0)];
      ++counts[edgeKey(t, 1)];
      ++counts[edgeKey(t, 2)];
    }
    std::vector<SoupEdgeUse> seen;
    auto expected = counts.begin();
    eachEdge(uses, [&](std::span<const SoupEdgeUse> ofEdge) {
      ASSERT_NE(expected, counts.end());
      EXPECT_EQ(ofEdge.size(), expected->second);
      EXPECT_TRUE(std::ranges::all_of(ofEdge, [&](const SoupEdgeUse& use) { return use.edge == expected->first; }));
      seen.insert(seen.end(), ofEdge.begin(), ofEdge.end());
      ++expected;
    });
    EXPECT_EQ(expected, counts.end());
    EXPECT_EQ(asTuples(seen), asTuples(uses));
  }
}

} // namespace
