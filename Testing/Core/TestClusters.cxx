// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how clusters and tangles of triangles are found, marked and hidden.
#include "Draw.h"
#include "RepairSamples.h"
#include "Support/QuietContext.h"
#include "Surface/Repair/Clusters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addTriangle;
using atria::testing::Draw;
using atria::testing::quietContext;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Clusters, BoundOfTriplesIsTheSumOfLowerDegrees)
{
  Draw draw(12);
  for (int round = 0; round < 100; ++round)
  {
    std::set<std::pair<Index, Index>> drawn;
    for (std::int64_t i = draw.in(0, 60); i > 0; --i)
    {
      const Index a = draw.below(14);
      const Index b = draw.below(14);
      if (a != b)
      {
        drawn.emplace(std::min(a, b), std::max(a, b));
      }
    }
    const TrianglePairs pairs(drawn.begin(), drawn.end());
    const auto degree = [&](Index t) {
      return std::ranges::count_if(pairs, [&](const auto& pair) { return pair.first == t || pair.second == t; });
    };
    std::ptrdiff_t expected = 0;
    for (const auto& [a, b] : pairs)
    {
      expected += std::min(degree(a), degree(b));
    }
    EXPECT_EQ(boundOfTriples(14, pairs), static_cast<std::size_t>(expected));
  }
}

TrianglePairs allPairs(Index count)
{
  TrianglePairs pairs;
  for (Index a = 0; a < count; ++a)
  {
    for (Index b = a + 1; b < count; ++b)
    {
      pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

TrianglePairs pairsOfOthers(const TrianglePairs& pairs, const std::vector<char>& isOut)
{
  TrianglePairs left;
  std::ranges::copy_if(pairs, std::back_inserter(left),
                       [&](const auto& pair) { return !isOut[pair.first] && !isOut[pair.second]; });
  return left;
}

TEST(Clusters, TanglesAreMarkedIfTheBoundIsBeyondTheLimit)
{
  const TrianglePairs pairs = allPairs(10); // 45 pairs of degree 9
  EXPECT_EQ(boundOfTriples(10, pairs), 405u);
  EXPECT_THAT(findTangles(10, pairs, 405), Each(0));
  for (const std::size_t limit : {404u, 200u, 81u, 80u, 1u})
  {
    const std::vector<char> isOut = findTangles(10, pairs, limit);
    EXPECT_EQ(isOut.size(), 10u);
    EXPECT_TRUE(std::ranges::is_sorted(isOut)) << "among equals the last ones";
    EXPECT_EQ(isOut.back(), 1);
    EXPECT_EQ(isOut.front(), 0) << "one alone makes no pairs";
    EXPECT_LE(boundOfTriples(10, pairsOfOthers(pairs, isOut)), limit);
  }
}

TEST(Clusters, TanglesAreMarkedFromTheDearestOn)
{
  // Triangle 3 meets all others; 6 and 7 also meet each other.
  TrianglePairs pairs{{6, 7}};
  for (Index t = 0; t < 9; ++t)
  {
    if (t != 3)
    {
      pairs.emplace_back(std::min<Index>(t, 3), std::max<Index>(t, 3));
    }
  }
  ASSERT_EQ(boundOfTriples(10, pairs), 2u + 6u + 4u);
  EXPECT_THAT(findTangles(10, pairs, 12), Each(0));
  // Costs are 1 six times, 4 twice, and 10. Triangle 9 costs nothing.
  EXPECT_THAT(findTangles(10, pairs, 10), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0, 0));
  EXPECT_THAT(findTangles(10, pairs, 9), ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 0, 0));
  EXPECT_THAT(findTangles(10, pairs, 5), ElementsAre(0, 0, 0, 1, 0, 0, 1, 1, 1, 0));
}

TEST(Clusters, SearchesEndBeyondTheMostPairs)
{
  EXPECT_NO_THROW(checkPairs(0));
  EXPECT_NO_THROW(checkPairs(mostPairs));
  EXPECT_THROW(checkPairs(mostPairs + 1), TooManyPairs);
}

/// Triangles in a few places, some of them repeated many times.
TriangleSoup crowd(Draw& draw, std::size_t count)
{
  TriangleSoup soup;
  for (std::size_t i = 0; i < count; ++i)
  {
    const LatticePoint p = draw.point(30);
    addTriangle(soup, p, {p[0] + draw.in(1, 20), p[1], p[2]}, {p[0], p[1] + draw.in(1, 20), p[2] + draw.in(0, 20)});
  }
  return soup;
}

/// Counts the pairs of triangles that are not marked whose boxes touch.
std::size_t countPairs(const TriangleSoup& soup, std::int64_t margin, const std::vector<char>& isOut)
{
  std::size_t pairs = 0;
  for (Index a = 0; a < soup.triangles.size(); ++a)
  {
    for (Index b = 0; b < a; ++b)
    {
      const auto boxOfTriangle = [&](Index t) {
        return grown(boundsOf(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2)), margin);
      };
      pairs += !isOut[a] && !isOut[b] && overlap(boxOfTriangle(a), boxOfTriangle(b)) ? 1 : 0;
    }
  }
  return pairs;
}

TEST(Clusters, AreMarkedForAnyLimit)
{
  Draw draw(14);
  const TriangleSoup soup = crowd(draw, 60);
  for (const std::size_t limit : {0, 1, 5, 20})
  {
    EXPECT_LE(countPairs(soup, 4, findClusters(soup, 4, limit, quietContext())), limit);
  }
}

TEST(Clusters, AreMarkedUntilPairsAreWithinTheLimit)
{
  Draw draw(13);
  for (int round = 0; round < 60; ++round)
  {
    const TriangleSoup soup = crowd(draw, 60);
    const std::int64_t margin = draw.in(2, 8);
    const std::size_t pairs = countPairs(soup, margin, std::vector<char>(60, 0));
    ASSERT_GT(pairs, 90u);
    EXPECT_THAT(findClusters(soup, margin, pairs, quietContext()), Each(0));
    for (const std::size_t limit : {pairs - 1, pairs / 2, std::size_t{60}})
    {
      const std::vector<char> isOut = findClusters(soup, margin, limit, quietContext());
      EXPECT_LE(countPairs(soup, margin, isOut), limit);
      EXPECT_GT(std::ranges::count(isOut, 1), 0);
      EXPECT_LT(std::ranges::count(isOut, 1), 60);
    }
  }
}

TEST(Clusters, KeepMarksAndDoNotCountThem)
{
  Draw draw(14);
  const TriangleSoup soup = crowd(draw, 60);
  std::vector<char> isOut(60, 0);
  std::fill_n(isOut.begin(), 30, 1);
  const std::size_t pairs = countPairs(soup, 3, isOut);
  EXPECT_EQ(findClusters(soup, 3, pairs, quietContext(), isOut), isOut);
  const std::vector<char> more = findClusters(soup, 3, pairs - 1, quietContext(), isOut);
  EXPECT_GT(std::ranges::count(more, 1), 30);
  EXPECT_EQ(std::count(more.begin(), more.begin() + 30, 1), 30);
  EXPECT_THAT(findClusters({}, 3, 0, quietContext()), IsEmpty());
}

TEST(Clusters, MarkTheTriangleThatTouchesAllOthers)
{
  TriangleSoup soup;
  for (std::int64_t i = 0; i < 64; ++i)
  {
    addTriangle(soup, {100 * i, 0, 0}, {100 * i + 9, 0, 0}, {100 * i, 9, 0});
  }
  addTriangle(soup, {0, 0, 0}, {6400, 0, 0}, {0, 9, 0});
  EXPECT_THAT(findClusters(soup, 0, 64, quietContext()), Each(0));
  EXPECT_EQ(findClusters(soup, 0, 63, quietContext()).back(), 1);
}

std::vector<char> hiddenIn(const ClusterCells& clusters, Index sources)
{
  std::vector<char> isHidden;
  for (Index s = 0; s < sources; ++s)
  {
    isHidden.push_back(clusters.isHidden(s) ? 1 : 0);
  }
  return isHidden;
}

/// Copies of one triangle, two to a source.
TriangleSoup copies(Index count)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {90, 0, 0}, {0, 90, 0}};
  for (Index t = 0; t < count; ++t)
  {
    soup.add({0, 1, 2}, 0, t / 2);
  }
  return soup;
}

TEST(Clusters, HideSourcesAsAWhole)
{
  const TriangleSoup soup = copies(12); // 66 pairs
  ClusterCells clusters;
  hideClusters(soup, 1, 66, clusters, quietContext());
  EXPECT_THAT(hiddenIn(clusters, 6), Each(0));
  clusters.hide(0);
  hideClusters(soup, 1, 45, clusters, quietContext()); // those of ten others
  EXPECT_THAT(hiddenIn(clusters, 6), ElementsAre(1, 0, 0, 0, 0, 0));
  hideClusters(soup, 1, 44, clusters, quietContext());
  const std::size_t seen = seenTriangles(soup, clusters, quietContext()).size();
  EXPECT_LE(seen * (seen - 1) / 2, 44u);
  EXPECT_LT(seen, 10u);
}

TEST(Clusters, SearchesAreRepeatedUntilTheyEnd)
{
  const TriangleSoup soup = copies(12);
  ClusterCells clusters;
  int runs = 0;
  const std::size_t found = searchSeen(soup, 1, clusters, quietContext(), [&] {
    ++runs;
    const std::size_t seen = seenTriangles(soup, clusters, quietContext()).size();
    if (seen * (seen - 1) / 2 > 20)
    {
      throw TooManyPairs{};
    }
    return seen;
  });
  EXPECT_LT(found, 8u);
  EXPECT_GT(runs, 2);
  EXPECT_EQ(searchSeen(soup, 1, clusters, quietContext(), [] { return 5; }), 5);
}

TEST(Clusters, HideTanglesOfTooManyPieces)
{
  // The bound is n (n - 1)^2 / 2: below five million for 216 triangles, and beyond for 217.
  for (const Index count : {216u, 217u})
  {
    const TriangleSoup soup = copies(count);
    ClusterCells clusters;
    const TrianglePairs pairs = allPairs(count);
    EXPECT_EQ(hideTangles(soup, pairs, clusters), count == 217);
    EXPECT_EQ(clusters.isHidden((count - 1) / 2), count == 217);
    EXPECT_FALSE(clusters.isHidden(0));
  }
}

} // namespace
