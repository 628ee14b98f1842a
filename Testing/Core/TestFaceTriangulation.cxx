// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests triangulations of faces on the lattice.
#include "Draw.h"
#include "LatticePlane.h"
#include "Surface/Triangles/TriangleSoup.h"
#include "Surface/Triangulation/FaceTriangulation.h"
#include "Surface/Triangulation/LatticeSegments.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Draw;
using atria::testing::placed;
using ::testing::IsEmpty;
using Triangles = std::vector<std::array<Index, 3>>;

constexpr double reach = 4.0;

/// Sum of directed edges: how often each is walked forward more than back, without those that cancel out.
std::map<EdgeKey, int> boundaryOf(const Triangles& triangles)
{
  std::map<EdgeKey, int> sum;
  for (const auto& t : triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      sum[edgeKey(t, i)] += t[i] < t[(i + 1) % 3] ? 1 : -1;
    }
  }
  std::erase_if(sum, [](const auto& entry) { return entry.second == 0; });
  return sum;
}

std::map<EdgeKey, int> outlineOf(const DividedFace& face)
{
  std::vector<Index> outline;
  for (std::size_t i = 0; i < 3; ++i)
  {
    outline.push_back(face.corners.at(i));
    outline.insert(outline.end(), face.alongEdges.at(i).begin(), face.alongEdges.at(i).end());
  }
  std::map<EdgeKey, int> sum;
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    const Index next = outline[(i + 1) % outline.size()];
    sum[edgeKey(outline[i], next)] += outline[i] < next ? 1 : -1;
  }
  std::erase_if(sum, [](const auto& entry) { return entry.second == 0; });
  return sum;
}

std::set<EdgeKey> edgesOf(const Triangles& triangles)
{
  std::set<EdgeKey> edges;
  for (const auto& t : triangles)
  {
    edges.insert({edgeKey(t, 0), edgeKey(t, 1), edgeKey(t, 2)});
  }
  return edges;
}

/// Checks that a segment is a row of edges.
void expectRow(const std::vector<LatticePoint>& points, const std::set<EdgeKey>& edges, const EdgeKey& segment)
{
  const LatticePoint& a = points[segment.first];
  const LatticePoint& b = points[segment.second];
  std::vector<std::pair<double, Index>> on{{0.0, segment.first}, {between(a, b).squaredNorm(), segment.second}};
  for (Index p = 0; p < points.size(); ++p)
  {
    if (liesOnSegment(points[p], a, b, 8.0))
    {
      on.emplace_back(between(a, b).dot(between(a, points[p])), p);
    }
  }
  std::ranges::sort(on);
  for (std::size_t i = 1; i < on.size(); ++i)
  {
    EXPECT_TRUE(edges.contains(edgeKey(on[i - 1].second, on[i].second)));
  }
}

/// A triangle, its points at eighths of its edges and of its inside, and some segments between them.
DividedFace drawFace(std::vector<LatticePoint>& points, Draw& draw)
{
  const auto corner = [&] {
    return LatticePoint{draw.in(-90, 90) * 80000, draw.in(-90, 90) * 80000, draw.in(-90, 90) * 80000};
  };
  const std::array<LatticePoint, 3> corners{corner(), corner(), corner()};
  const auto add = [&](std::int64_t i, std::int64_t j) {
    LatticePoint p;
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = ((8 - i - j) * corners[0][axis] + i * corners[1][axis] + j * corners[2][axis]) / 8;
    }
    points.push_back(p);
    return static_cast<Index>(points.size() - 1);
  };
  DividedFace face;
  face.corners = {add(0, 0), add(8, 0), add(0, 8)};
  for (std::int64_t i = 1; i < 8; ++i)
  {
    const std::array<std::array<std::int64_t, 2>, 3> along{{{i, 0}, {8 - i, i}, {0, 8 - i}}};
    for (std::size_t side = 0; side < 3; ++side)
    {
      if (draw.in(0, 2) == 0)
      {
        face.alongEdges.at(side).push_back(add(along.at(side)[0], along.at(side)[1]));
      }
    }
    for (std::int64_t j = 1; i + j < 8; ++j)
    {
      if (draw.in(0, 3) == 0)
      {
        face.inside.push_back(add(i, j));
      }
    }
  }
  for (std::int64_t i = draw.in(0, 6); i > 0; --i)
  {
    const Index a = draw.below(points.size());
    const Index b = draw.below(points.size());
    if (a != b)
    {
      face.segments.push_back(edgeKey(a, b));
    }
  }
  return face;
}

TEST(FaceTriangulation, HasTheOutlineOfTheFaceAndItsSegments)
{
  Draw draw(7);
  for (int round = 0; round < 300; ++round)
  {
    std::vector<LatticePoint> points;
    DividedFace face = drawFace(points, draw);
    const DividedFace before = face;
    const Vec3 normal = between(points[0], points[1]).cross(between(points[0], points[2]));
    Triangles triangles{{9, 8, 7}};
    triangulateFace(points, face, reach, triangles);
    ASSERT_EQ(triangles.front(), (std::array<Index, 3>{9, 8, 7})) << "it appends";
    triangles.erase(triangles.begin());
    EXPECT_EQ(boundaryOf(triangles), outlineOf(before));
    double area = 0.0;
    std::set<Index> used;
    for (const auto& t : triangles)
    {
      const Vec3 ofPiece = between(points[t[0]], points[t[1]]).cross(between(points[t[0]], points[t[2]]));
      EXPECT_GT(ofPiece.dot(normal), 0.0) << round;
      area += ofPiece.norm();
      used.insert(t.begin(), t.end());
    }
    EXPECT_NEAR(area, normal.norm(), 1e-5 * normal.norm());
    EXPECT_EQ(used.size(), points.size()) << "each point is in the triangulation";
    const std::set<EdgeKey> edges = edgesOf(triangles);
    std::ranges::for_each(before.segments, [&](const EdgeKey& segment) { expectRow(points, edges, segment); });
  }
}

TEST(FaceTriangulation, KeepsATriangleWithoutPoints)
{
  for (const auto& corners : {std::array<Index, 3>{0, 1, 2}, std::array<Index, 3>{2, 1, 0}})
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      std::vector<LatticePoint> points{placed(0, 0, axis, 0), placed(500, 0, axis, 0), placed(0, 500, axis, 0)};
      DividedFace face{corners, {}, {}, {}};
      Triangles triangles;
      triangulateFace(points, face, reach, triangles);
      ASSERT_EQ(triangles.size(), 1u);
      EXPECT_EQ(boundaryOf(triangles), boundaryOf({corners}));
    }
  }
}

TEST(FaceTriangulation, JoinsNoPointsAlongAnEdgeThatRoundingTookBeyondIt)
{
  // The points of the longest edge lie up to two lattice units beyond it or within.
  for (const std::int64_t offset : {-2, -1, 0, 1, 2})
  {
    std::vector<LatticePoint> points{{0, 0, 0}, {9000, 0, 0}, {3000, 6000, 0}, {3000, offset, 0}, {6000, -offset, 0}};
    DividedFace face{{0, 1, 2}, {{{3, 4}, {}, {}}}, {}, {}};
    const DividedFace before = face;
    Triangles triangles;
    triangulateFace(points, face, reach, triangles);
    EXPECT_EQ(triangles.size(), 3u);
    EXPECT_EQ(boundaryOf(triangles), outlineOf(before));
    for (const auto& t : triangles)
    {
      EXPECT_TRUE(contains(t, 2)) << offset;
    }
  }
}

TEST(FaceTriangulation, CutsAFaceWithoutAreaIntoAFan)
{
  Draw draw(8);
  for (int round = 0; round < 300; ++round)
  {
    std::vector<LatticePoint> points;
    for (std::int64_t i = 0; i < 10; ++i)
    {
      points.push_back({100 * i, 200 * i, -300 * i});
    }
    DividedFace face{{0, 9, draw.below(8) + 1}, {}, {}, {}};
    for (Index p = 1; p < 9; ++p)
    {
      if (p != face.corners[2] && draw.in(0, 1) == 0)
      {
        face.alongEdges[0].push_back(p);
      }
      if (p > face.corners[2] && draw.in(0, 1) == 0)
      {
        face.alongEdges[1].insert(face.alongEdges[1].begin(), p);
      }
      if (p < face.corners[2] && draw.in(0, 1) == 0)
      {
        face.alongEdges[2].insert(face.alongEdges[2].begin(), p);
      }
    }
    Triangles triangles;
    triangulateFace(points, face, reach, triangles);
    EXPECT_EQ(boundaryOf(triangles), outlineOf(face));
    std::set<std::array<Index, 3>> seen;
    for (std::array<Index, 3> t : triangles)
    {
      std::ranges::sort(t);
      EXPECT_TRUE(seen.insert(t).second) << "no two triangles cover each other";
    }
  }
}

TEST(FaceTriangulation, OfALineWithAllPointsOnBothSidesIsEmpty)
{
  std::vector<LatticePoint> points{{0, 0, 0}, {40, 0, 0}, {20, 0, 0}, {10, 0, 0}, {30, 0, 0}};
  DividedFace face{{0, 1, 2}, {{{3, 2, 4}, {4}, {3}}}, {}, {}};
  Triangles triangles;
  triangulateFace(points, face, reach, triangles);
  EXPECT_THAT(triangles, IsEmpty());
}

} // namespace
