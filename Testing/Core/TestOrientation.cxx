// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how triangles are wound, against naive references.
#include "Draw.h"
#include "SoupSamples.h"
#include "Support/Executor.h"
#include "Surface/Triangles/Orientation.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addBox;
using atria::testing::addStrip;
using atria::testing::asTuples;
using atria::testing::Draw;
using atria::testing::naiveUses;
using atria::testing::Triangle;

Triangle turned(const Triangle& t) { return {t[0], t[2], t[1]}; }

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

} // namespace
