// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests edges, winding and connected parts of triangles on the lattice against naive references.
#include "Surface/Triangles/TriangleSoup.h"

#include "Surface/Triangles/EachEdge.h"
#include "Surface/Triangles/Orientation.h"
#include "Surface/Triangles/SoupParts.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using ::testing::ElementsAre;
using Triangle = std::array<Index, 3>;

class Draw
{
public:
  explicit Draw(unsigned seed) : random_(seed) {}

  std::int64_t in(std::int64_t low, std::int64_t high)
  {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random_);
  }
  Index below(std::size_t count) { return static_cast<Index>(in(0, static_cast<std::int64_t>(count) - 1)); }
  LatticePoint point(std::int64_t reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }

  /// Returns triangles without repeated points between random points.
  TriangleSoup soup(std::size_t points, std::size_t triangles)
  {
    TriangleSoup made;
    for (std::size_t i = 0; i < points; ++i)
    {
      made.points.push_back(point(50));
    }
    while (made.triangles.size() < triangles)
    {
      const Triangle t{below(points), below(points), below(points)};
      if (!hasRepeatedPoint(t))
      {
        made.add(t, 0, static_cast<Index>(made.triangles.size()));
      }
    }
    return made;
  }

private:
  std::mt19937 random_;
};

// Triangles and their edges.

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

using Use = std::tuple<Index, Index, Index, bool>;

/// Uses by edge, then by triangle.
std::vector<Use> naiveUses(const std::vector<Triangle>& triangles)
{
  std::vector<Use> uses;
  for (Index t = 0; t < triangles.size(); ++t)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Index a = triangles[t].at(i);
      const Index b = triangles[t].at((i + 1) % 3);
      uses.emplace_back(std::min(a, b), std::max(a, b), t, a < b);
    }
  }
  std::ranges::sort(uses);
  return uses;
}

std::vector<Use> asTuples(const std::vector<SoupEdgeUse>& uses)
{
  std::vector<Use> out;
  std::ranges::transform(uses, std::back_inserter(out), [](const SoupEdgeUse& use) {
    return Use{use.edge.first, use.edge.second, use.triangle, use.forward};
  });
  return out;
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

// Winding.

Triangle turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

/// Adds a closed box, wound outward.
void addBox(TriangleSoup& soup, const LatticePoint& low, std::int64_t size)
{
  const auto first = static_cast<Index>(soup.points.size());
  for (std::int64_t i = 0; i < 8; ++i)
  {
    soup.points.push_back({low[0] + size * (i % 2), low[1] + size * (i / 2 % 2), low[2] + size * (i / 4)});
  }
  for (const Triangle& t : {Triangle{0, 2, 3},
                            {0, 3, 1},
                            {4, 5, 7},
                            {4, 7, 6},
                            {0, 1, 5},
                            {0, 5, 4},
                            {2, 6, 7},
                            {2, 7, 3},
                            {0, 4, 6},
                            {0, 6, 2},
                            {1, 3, 7},
                            {1, 7, 5}})
  {
    soup.add({first + t[0], first + t[1], first + t[2]}, 0, static_cast<Index>(soup.triangles.size()));
  }
}

/// Adds a row of squares along x, wound upward.
void addStrip(TriangleSoup& soup, std::int64_t y, Index squares)
{
  const auto first = static_cast<Index>(soup.points.size());
  for (Index i = 0; i <= squares; ++i)
  {
    soup.points.insert(soup.points.end(), {{10 * std::int64_t{i}, y, 0}, {10 * std::int64_t{i}, y + 10, 0}});
  }
  for (Index p = first; p < first + 2 * squares; p += 2)
  {
    soup.add({p, p + 2, p + 3}, 0, static_cast<Index>(soup.triangles.size()));
    soup.add({p, p + 3, p + 1}, 0, static_cast<Index>(soup.triangles.size()));
  }
}

TEST(Orientation, TurnsClosedPiecesOutward)
{
  TriangleSoup outward;
  addBox(outward, {0, 0, 0}, 100);
  addBox(outward, {20, 20, 20}, 50); // within the first
  addBox(outward, {-500, 0, 0}, 10);
  Draw draw(4);
  for (int round = 0; round < 100; ++round)
  {
    TriangleSoup soup = outward;
    std::size_t count = 0;
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    {
      if (draw.in(0, 3) == 0 || round < 2)
      {
        soup.triangles[t] = turned(soup.triangles[t]);
        ++count;
      }
    }
    EXPECT_EQ(orientTriangles(soup, SerialExecutor()), count);
    for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    {
      Triangle expected = outward.triangles[t];
      EXPECT_TRUE(std::ranges::is_permutation(expected, soup.triangles[t]));
      while (expected[0] != soup.triangles[t][0])
      {
        std::ranges::rotate(expected, expected.begin() + 1);
      }
      EXPECT_EQ(soup.triangles[t], expected);
    }
  }
}

TEST(Orientation, OfOpenPiecesIsThatOfTheGreaterArea)
{
  for (std::size_t up = 0; up <= 8; ++up)
  {
    TriangleSoup soup;
    addStrip(soup, 0, 4);
    const std::vector<Triangle> upward = soup.triangles;
    for (std::size_t t = up; t < 8; ++t)
    {
      soup.triangles[t] = turned(soup.triangles[t]);
    }
    EXPECT_EQ(orientTriangles(soup, SerialExecutor()), std::min(up, 8 - up));
    // With four each, the first triangle decides, which points upward.
    for (std::size_t t = 0; t < 8; ++t)
    {
      EXPECT_EQ(soup.triangles[t], up >= 4 ? upward[t] : turned(upward[t])) << up;
    }
  }
}

TEST(Orientation, OfOpenPiecesCountsAreaNotTriangles)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}, {-90, 90, 0}};
  soup.add({0, 1, 2}, 0, 0);
  soup.add({1, 3, 2}, 0, 1);
  soup.add({4, 2, 0}, 0, 2); // the largest, wound the other way
  EXPECT_EQ(orientTriangles(soup, SerialExecutor()), 2u);
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 2, 1}, {1, 2, 3}, {4, 2, 0}}));
}

TEST(Orientation, DoesNotPassEdgesOfThreeTriangles)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, -10, 0}, {0, 0, 10}};
  soup.add({0, 1, 2}, 0, 0);
  soup.add({0, 1, 3}, 0, 1);
  soup.add({0, 1, 4}, 0, 2);
  const std::vector<Triangle> before = soup.triangles;
  EXPECT_EQ(orientTriangles(soup, SerialExecutor()), 0u);
  EXPECT_EQ(soup.triangles, before);
  soup.triangles.pop_back();
  EXPECT_EQ(orientTriangles(soup, SerialExecutor()), 1u) << "without the third they must agree";
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 3, 1}}));
}

TEST(Orientation, LeavesAMoebiusStripAlone)
{
  for (const Index length : {5u, 6u})
  {
    TriangleSoup soup;
    addStrip(soup, 0, length);
    // The end is joined to the start, twisted.
    for (Triangle& t : soup.triangles)
    {
      std::ranges::replace(t, 2 * length, 1u);
      std::ranges::replace(t, 2 * length + 1, 0u);
    }
    soup.triangles[3] = turned(soup.triangles[3]);
    const std::vector<Triangle> before = soup.triangles;
    EXPECT_EQ(orientTriangles(soup, SerialExecutor()), 0u);
    EXPECT_EQ(soup.triangles, before);
  }
}

TEST(Orientation, OfNothingTurnsNothing)
{
  TriangleSoup soup;
  EXPECT_EQ(orientTriangles(soup, SerialExecutor()), 0u);
}

/// Returns the triangles of each edge, with true if they run forward.
std::map<EdgeKey, std::vector<std::pair<Index, bool>>> naiveEdges(const std::vector<Triangle>& triangles)
{
  std::map<EdgeKey, std::vector<std::pair<Index, bool>>> edges;
  for (const auto& [a, b, t, forward] : naiveUses(triangles))
  {
    edges[{a, b}].emplace_back(t, forward);
  }
  return edges;
}

/// Pairs of triangles with an edge that only they have; true if they are wound alike.
std::map<std::pair<Index, Index>, std::set<bool>> naiveJoints(const std::vector<Triangle>& triangles)
{
  std::map<std::pair<Index, Index>, std::set<bool>> joints;
  for (const auto& [edge, uses] : naiveEdges(triangles))
  {
    if (uses.size() == 2)
    {
      joints[{uses[0].first, uses[1].first}].insert(uses[0].second != uses[1].second);
    }
  }
  return joints;
}

/// The number of each triangle's piece.
std::vector<Index> naivePieces(const std::vector<Triangle>& triangles)
{
  std::vector<Index> piece(triangles.size());
  std::iota(piece.begin(), piece.end(), Index{0});
  for (const auto& [pair, alike] : naiveJoints(triangles))
  {
    const Index first = piece[pair.first];
    const Index second = piece[pair.second];
    std::ranges::replace(piece, std::max(first, second), std::min(first, second));
  }
  return piece;
}

Vec3 areaOf(const TriangleSoup& soup, const Triangle& t)
{
  return between(soup.points[t[0]], soup.points[t[1]]).cross(between(soup.points[t[0]], soup.points[t[2]]));
}

bool isClosed(const std::vector<Triangle>& triangles, const std::vector<Index>& pieces, Index piece)
{
  return std::ranges::all_of(naiveEdges(triangles), [&](const auto& entry) {
    return entry.second.size() == 2 ||
           std::ranges::none_of(entry.second, [&](const auto& use) { return pieces[use.first] == piece; });
  });
}

/// Checks one piece: consistent, and outward or of the greater area; else unchanged, as it has one side only.
void expectOriented(const TriangleSoup& before, const TriangleSoup& after, const std::vector<Index>& pieces,
                    Index piece)
{
  bool isConsistent = true;
  for (const auto& [pair, alike] : naiveJoints(after.triangles))
  {
    isConsistent = isConsistent && (pieces[pair.first] != piece || alike == std::set<bool>{true});
  }
  double kept = 0.0;
  double changed = 0.0;
  double volume = 0.0;
  for (std::size_t t = 0; t < pieces.size(); ++t)
  {
    if (pieces[t] == piece)
    {
      const bool isKept = before.triangles[t] == after.triangles[t];
      (isKept ? kept : changed) += areaOf(before, before.triangles[t]).norm();
      volume += areaOf(after, after.triangles[t]).dot(toVector(after.points[after.triangles[t][0]]));
    }
  }
  if (!isConsistent)
  {
    EXPECT_EQ(changed, 0.0) << "it has one side";
  }
  else if (isClosed(before.triangles, pieces, piece))
  {
    EXPECT_GE(volume, 0.0);
  }
  else
  {
    EXPECT_GE(kept * (1.0 + 2e-6), changed);
  }
}

TEST(Orientation, IsConsistentInAnySoup)
{
  Draw draw(5);
  std::size_t turns = 0;
  for (int round = 0; round < 300; ++round)
  {
    const TriangleSoup before = draw.soup(5 + draw.below(12), 1 + draw.below(18));
    TriangleSoup after = before;
    const std::size_t count = orientTriangles(after, SerialExecutor());
    std::size_t changed = 0;
    for (std::size_t t = 0; t < before.triangles.size(); ++t)
    {
      changed += before.triangles[t] != after.triangles[t] ? 1 : 0;
      EXPECT_TRUE(after.triangles[t] == before.triangles[t] || after.triangles[t] == turned(before.triangles[t]));
    }
    EXPECT_EQ(count, changed);
    turns += count;
    const std::vector<Index> pieces = naivePieces(before.triangles);
    for (const Index piece : std::set<Index>(pieces.begin(), pieces.end()))
    {
      expectOriented(before, after, pieces, piece);
    }
  }
  EXPECT_GT(turns, 100u);
}

TEST(Orientation, IsConsistentInEveryPieceThatCanBe)
{
  Draw draw(6);
  for (int round = 0; round < 100; ++round)
  {
    // A strip has two sides, however its triangles are wound.
    TriangleSoup soup;
    addStrip(soup, 0, 6);
    addStrip(soup, 30, 3);
    for (Triangle& t : soup.triangles)
    {
      std::ranges::rotate(t, t.begin() + draw.in(0, 2));
      t = draw.in(0, 1) == 0 ? t : turned(t);
    }
    orientTriangles(soup, SerialExecutor());
    for (const auto& [pair, alike] : naiveJoints(soup.triangles))
    {
      EXPECT_EQ(alike, std::set<bool>{true});
    }
  }
}

TEST(Orientation, KeepsTheUsesOfEdgesUpToDate)
{
  Draw draw(7);
  for (int round = 0; round < 100; ++round)
  {
    TriangleSoup soup = draw.soup(8, 15);
    TriangleSoup same = soup;
    std::vector<SoupEdgeUse> uses = sortedEdgeUses(soup, SerialExecutor());
    const std::size_t count = orientTriangles(soup, std::span<SoupEdgeUse>(uses));
    EXPECT_EQ(asTuples(uses), naiveUses(soup.triangles));
    EXPECT_EQ(orientTriangles(same, SerialExecutor()), count);
    EXPECT_EQ(same.triangles, soup.triangles);
  }
}

// Connected parts.

TEST(SoupParts, AreNumberedByTheGreatestFaceOfTheirBoxes)
{
  TriangleSoup soup;
  addBox(soup, {0, 0, 0}, 10);                                                                       // faces of 100
  addBox(soup, {100, 0, 0}, 9);                                                                      // 81
  addBox(soup, {200, 0, 0}, 11);                                                                     // 121
  addStrip(soup, 500, 9);                                                                            // 90 * 10 = 900
  soup.points.push_back({7, 7, 7});                                                                  // of no triangle
  const std::array<std::array<LatticePoint, 3>, 3> lone{{{{{0, 900, 0}, {0, 900, 40}, {0, 902, 0}}}, // 80 across x
                                                         {{{0, 990, 0}, {0, 990, 41}, {2, 990, 0}}}, // 82 across y
                                                         {{{0, 800, 0}, {42, 800, 0}, {42, 802, 0}}}}}; // 84 across z
  for (const auto& corners : lone)
  {
    const auto first = static_cast<Index>(soup.points.size());
    soup.points.insert(soup.points.end(), corners.begin(), corners.end());
    soup.add({first, first + 1, first + 2}, 0, static_cast<Index>(soup.triangles.size()));
  }
  std::vector<Index> expected(12, 4);
  expected.insert(expected.end(), 12, 1);
  expected.insert(expected.end(), 12, 5);
  expected.insert(expected.end(), 18, 6);
  expected.insert(expected.end(), {0, 2, 3});
  EXPECT_EQ(partsOf(soup), expected);
}

TEST(SoupParts, OfEqualSizeAreNumberedByTheirLowestPointDownward)
{
  TriangleSoup soup;
  for (std::int64_t i = 0; i < 3; ++i)
  {
    addBox(soup, {100 * i, 0, 0}, 10);
  }
  const std::vector<Index> parts = partsOf(soup);
  EXPECT_EQ(parts[0], 2u);
  EXPECT_EQ(parts[12], 1u);
  EXPECT_EQ(parts[24], 0u);
}

TEST(SoupParts, HaveOneEntryPerSource)
{
  TriangleSoup soup;
  soup.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}, {50, 0, 0}, {60, 0, 0}, {50, 10, 0}};
  soup.add({0, 1, 2}, 0, 2); // two pieces of one source
  soup.add({1, 3, 2}, 0, 2);
  soup.add({4, 5, 6}, 0, 5);
  const std::vector<Index> parts = partsOf(soup);
  ASSERT_EQ(parts.size(), 6u);
  EXPECT_EQ(parts[2], 1u);
  EXPECT_EQ(parts[5], 0u);
  EXPECT_TRUE(partsOf(TriangleSoup{}).empty());
}

/// Gives each point the lowest one of its part.
std::vector<Index> naiveParts(const TriangleSoup& soup)
{
  std::vector<Index> lowest(soup.points.size());
  std::iota(lowest.begin(), lowest.end(), Index{0});
  for (std::size_t turns = 0; turns < soup.points.size(); ++turns)
  {
    for (const auto& [a, b, c] : soup.triangles)
    {
      lowest[a] = lowest[b] = lowest[c] = std::min({lowest[a], lowest[b], lowest[c]});
    }
  }
  return lowest;
}

TEST(SoupParts, AreConnectedByCommonPoints)
{
  Draw draw(8);
  for (int round = 0; round < 100; ++round)
  {
    const TriangleSoup soup = draw.soup(30, 1 + draw.below(15));
    const std::vector<Index> lowest = naiveParts(soup);
    const std::vector<Index> parts = partsOf(soup);
    ASSERT_EQ(parts.size(), soup.triangles.size());
    std::map<Index, Index> partOf;
    std::set<Index> numbers;
    for (std::size_t t = 0; t < parts.size(); ++t)
    {
      EXPECT_EQ(partOf.try_emplace(lowest[soup.triangles[t][0]], parts[t]).first->second, parts[t]);
      numbers.insert(parts[t]);
    }
    EXPECT_EQ(numbers.size(), partOf.size()) << "two parts have two numbers";
    EXPECT_EQ(*numbers.rbegin() + 1, partOf.size()) << "numbers follow each other";
  }
}

} // namespace
