// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests triangulations of points and segments in the plane against naive references. Points are on a small grid, where
/// products of doubles are exact.
#include "Draw.h"
#include "Surface/Triangles/TriangleSoup.h"
#include "Surface/Triangulation/PlanarTriangulation.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Draw;
using ::testing::IsEmpty;
using Segments = std::vector<std::array<Index, 2>>;

double turn(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Twice the area of the convex hull: the sum over the edges that have no point on their right.
double hullArea(const std::vector<Vec2>& points)
{
  double sum = 0.0;
  for (const Vec2& a : points)
  {
    for (const Vec2& b : points)
    {
      const bool isEdge = a != b && std::ranges::all_of(points, [&](const Vec2& p) {
                            const double side = turn(a, b, p);
                            return side > 0.0 || (side == 0.0 && (p - a).dot(p - b) <= 0.0);
                          });
      const auto repeats = static_cast<double>(std::ranges::count(points, a) * std::ranges::count(points, b));
      sum += isEdge ? turn(points[0], a, b) / repeats : 0.0;
    }
  }
  return sum;
}

double areaOf(const PlanarTriangulation& plane, const std::array<Index, 3>& t)
{
  return turn(plane.points[t[0]], plane.points[t[1]], plane.points[t[2]]);
}

Index firstAt(const std::vector<Vec2>& points, const Vec2& p)
{
  return static_cast<Index>(std::ranges::find(points, p) - points.begin());
}

void expectCoversHull(const std::vector<Vec2>& points, const PlanarTriangulation& plane)
{
  double area = 0.0;
  for (const auto& t : plane.triangles)
  {
    EXPECT_GT(areaOf(plane, t), 0.0);
    area += areaOf(plane, t);
    for (const Index p : t)
    {
      EXPECT_EQ(firstAt(plane.points, plane.points[p]), p);
    }
  }
  EXPECT_NEAR(area, hullArea(points), 1e-9);
  ASSERT_GE(plane.points.size(), points.size());
  EXPECT_TRUE(std::equal(points.begin(), points.end(), plane.points.begin()));
}

/// True if p is strictly within the circle through the corners of a counterclockwise triangle.
bool isInCircle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p)
{
  Eigen::Matrix3d rows;
  rows << a[0] - p[0], a[1] - p[1], (a - p).squaredNorm(), b[0] - p[0], b[1] - p[1], (b - p).squaredNorm(), c[0] - p[0],
      c[1] - p[1], (c - p).squaredNorm();
  return rows.determinant() > 1e-6;
}

TEST(PlanarTriangulation, OfPointsIsDelaunay)
{
  Draw draw(1);
  for (int round = 0; round < 150; ++round)
  {
    const std::vector<Vec2> points = draw.points(static_cast<std::size_t>(draw.in(3, 25)), 12);
    const PlanarTriangulation plane = triangulatePlane(points, {});
    expectCoversHull(points, plane);
    EXPECT_EQ(plane.points.size(), points.size());
    EXPECT_TRUE(plane.simple);
    for (const auto& [a, b, c] : plane.triangles)
    {
      EXPECT_FALSE(
          std::ranges::any_of(points, [&](const Vec2& p) { return isInCircle(points[a], points[b], points[c], p); }));
    }
    EXPECT_EQ(plane.regions, std::vector<Index>(plane.triangles.size(), 0)) << "no segment divides it";
    EXPECT_EQ(plane.regionCount, plane.triangles.empty() ? 0u : 1u);
  }
}

TEST(PlanarTriangulation, OfFewPointsOrALineIsEmpty)
{
  const std::vector<std::vector<Vec2>> lists{
      {}, {{1, 2}}, {{1, 2}, {3, 4}}, {{0, 0}, {1, 2}, {2, 4}, {1, 2}}, {{1, 1}, {1, 1}, {1, 1}}};
  for (const std::vector<Vec2>& points : lists)
  {
    Segments segments;
    for (Index i = 0; i + 1 < points.size(); ++i)
    {
      segments.push_back({i, i + 1});
    }
    const PlanarTriangulation plane = triangulatePlane(points, segments);
    EXPECT_THAT(plane.triangles, IsEmpty());
    EXPECT_THAT(plane.regions, IsEmpty());
    EXPECT_EQ(plane.points, points);
    EXPECT_TRUE(plane.simple);
  }
}

TEST(PlanarTriangulation, HasSegmentsAsEdgesAgainstTheShorterDiagonal)
{
  const std::vector<Vec2> points{{0, 0}, {4, -1}, {8, 0}, {4, 1}};
  for (const Segments& segments : {Segments{{0, 2}}, Segments{{2, 0}}})
  {
    const PlanarTriangulation plane = triangulatePlane(points, segments);
    ASSERT_EQ(plane.triangles.size(), 2u);
    for (const auto& t : plane.triangles)
    {
      EXPECT_TRUE(contains(t, 0) && contains(t, 2));
    }
  }
  for (const auto& t : triangulatePlane(points, {}).triangles)
  {
    EXPECT_TRUE(contains(t, 1) && contains(t, 3));
  }
}

TEST(PlanarTriangulation, CutsSegmentsWhereTheyCross)
{
  const std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  const Segments crossing{{0, 2}, {1, 3}};
  const PlanarTriangulation plane = triangulatePlane(points, crossing);
  ASSERT_EQ(plane.points.size(), 5u);
  EXPECT_LT((plane.points[4] - Vec2(2, 1)).norm(), 1e-12);
  EXPECT_EQ(plane.triangles.size(), 4u);
  EXPECT_TRUE(plane.simple);
  EXPECT_EQ(plane.regions, std::vector<Index>(4, 0)) << "each is reached from the hull";
  EXPECT_EQ(plane.regionCount, 1u);
}

TEST(PlanarTriangulation, LeavesOutLaterSegmentsIfCrossingsAreNotCut)
{
  const std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  const std::array<std::pair<Segments, std::array<Index, 2>>, 2> cases{
      {{{{0, 2}, {1, 3}}, {0, 2}}, {{{1, 3}, {0, 2}}, {1, 3}}}};
  for (const auto& [segments, diagonal] : cases)
  {
    const PlanarTriangulation plane = triangulatePlane(points, segments, {0, 0, false});
    EXPECT_FALSE(plane.simple);
    EXPECT_THAT(plane.regions, IsEmpty());
    EXPECT_EQ(plane.points, points);
    ASSERT_EQ(plane.triangles.size(), 2u);
    for (const auto& t : plane.triangles)
    {
      EXPECT_TRUE(contains(t, diagonal[0]) && contains(t, diagonal[1]));
    }
  }
}

TEST(PlanarTriangulation, IsSimpleIfSegmentsOnlyOverlapOrPassThroughPoints)
{
  const std::vector<Vec2> points{{0, 0}, {2, 0}, {4, 0}, {6, 0}, {3, 3}};
  const PlanarTriangulation plane = triangulatePlane(points, Segments{{0, 2}, {1, 3}, {0, 3}}, {0, 0, false});
  EXPECT_TRUE(plane.simple);
  EXPECT_EQ(plane.triangles.size(), 3u);
  EXPECT_EQ(plane.regions, std::vector<Index>(3, 0));
}

/// Even-odd rule: number of outline edges right of p, which is on none of them.
bool isInside(const std::vector<Vec2>& points, const Segments& outline, const Vec2& p)
{
  bool isIn = false;
  for (const auto& [i, j] : outline)
  {
    const Vec2& a = points[i];
    const Vec2& b = points[j];
    if ((a[1] > p[1]) != (b[1] > p[1]))
    {
      isIn ^= a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > p[0];
    }
  }
  return isIn;
}

Vec2 centerOf(const PlanarTriangulation& plane, const std::array<Index, 3>& t)
{
  return (plane.points[t[0]] + plane.points[t[1]] + plane.points[t[2]]) / 3.0;
}

TEST(PlanarTriangulation, KnowsTheInsideOfAnOutlineByTheEvenOddRule)
{
  Draw draw(2);
  std::size_t inside = 0;
  for (int round = 0; round < 200; ++round)
  {
    // A random walk through some points, closed; then points and segments that are no outline.
    std::vector<Vec2> points = draw.points(static_cast<std::size_t>(draw.in(3, 9)), 9);
    const PlanarOutline outline{points.size(), points.size(), true};
    Segments segments;
    for (Index i = 0; i < points.size(); ++i)
    {
      segments.push_back({i, static_cast<Index>((i + 1) % points.size())});
    }
    const Segments walk = segments;
    const std::vector<Vec2> more = draw.points(5, 9);
    points.insert(points.end(), more.begin(), more.end());
    segments.push_back({draw.below(points.size()), draw.below(points.size())});
    segments.push_back({draw.below(points.size()), draw.below(points.size())});
    const PlanarTriangulation plane = triangulatePlane(points, segments, outline);
    EXPECT_TRUE(plane.simple);
    ASSERT_EQ(plane.regions.size(), plane.triangles.size());
    EXPECT_EQ(plane.regionCount, plane.triangles.empty() ? 0u : 2u);
    for (std::size_t t = 0; t < plane.triangles.size(); ++t)
    {
      if (areaOf(plane, plane.triangles[t]) > 1e-6) // crossings are rounded
      {
        const bool isIn = isInside(points, walk, centerOf(plane, plane.triangles[t]));
        EXPECT_EQ(plane.isOutside(t), !isIn) << round;
        EXPECT_EQ(plane.regions[t], isIn ? 1u : 0u);
        inside += isIn ? 1 : 0;
      }
    }
  }
  EXPECT_GT(inside, 500u);
}

TEST(PlanarTriangulation, WalksABridgeBothWaysWithoutABorder)
{
  const std::vector<Vec2> points{{0, 0}, {6, 0}, {6, 6}, {0, 6}, {2, 2}, {2, 4}, {4, 4}, {4, 2}};
  const Segments segments{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {4, 0}};
  const PlanarTriangulation plane = triangulatePlane(points, segments, {8, 10, true});
  double area = 0.0;
  for (std::size_t t = 0; t < plane.triangles.size(); ++t)
  {
    area += plane.isOutside(t) ? 0.0 : areaOf(plane, plane.triangles[t]);
  }
  EXPECT_NEAR(area, 2.0 * (36.0 - 4.0), 1e-12);
}

/// True if a and b lie on one of the segments.
bool isOnSegments(const std::vector<Vec2>& points, const Segments& segments, const Vec2& a, const Vec2& b)
{
  return std::ranges::any_of(segments, [&](const auto& segment) {
    const Vec2& from = points[segment[0]];
    const Vec2& to = points[segment[1]];
    const auto lies = [&](const Vec2& p) {
      return std::abs(turn(from, to, p)) < 1e-9 && (p - from).dot(p - to) <= 1e-9;
    };
    return from != to && lies(a) && lies(b);
  });
}

/// Returns the pairs of triangles with a common edge on no segment, as numbers from 1 on; 0 is beyond the hull.
std::vector<std::pair<Index, Index>> naiveDoors(const PlanarTriangulation& plane, const std::vector<Vec2>& points,
                                                const Segments& segments)
{
  std::map<EdgeKey, std::vector<Index>> uses;
  for (Index t = 0; t < plane.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      uses[edgeKey(plane.triangles[t], i)].push_back(t + 1);
    }
  }
  std::vector<std::pair<Index, Index>> doors;
  for (const auto& [edge, triangles] : uses)
  {
    if (!isOnSegments(points, segments, plane.points[edge.first], plane.points[edge.second]))
    {
      doors.emplace_back(triangles.size() == 1 ? 0 : triangles[0], triangles.back());
    }
  }
  return doors;
}

/// The parts that segments divide the triangles into, 0 for those reached from the hull.
std::vector<Index> naiveRegions(const PlanarTriangulation& plane, const std::vector<Vec2>& points,
                                const Segments& segments)
{
  std::vector<Index> part(plane.triangles.size() + 1);
  std::iota(part.begin(), part.end(), Index{0});
  for (const auto& [from, to] : naiveDoors(plane, points, segments))
  {
    const std::pair<Index, Index> joined = std::minmax(part[from], part[to]);
    std::ranges::replace(part, Index{joined.second}, Index{joined.first});
  }
  part.erase(part.begin());
  return part;
}

TEST(PlanarTriangulation, HasARegionForEachPartThatSegmentsEnclose)
{
  Draw draw(3);
  Index most = 0;
  for (int round = 0; round < 60; ++round)
  {
    // Segments along the axes cross in points of the grid, so that rounding moves none.
    std::vector<Vec2> points;
    Segments segments;
    for (Index i = 0; i < 14; ++i)
    {
      const Vec2 from = draw.points(1, 5).front();
      Vec2 to = from;
      to[static_cast<int>(i % 2)] = static_cast<double>(draw.in(0, 5));
      points.insert(points.end(), {from, to});
      segments.push_back({2 * i, 2 * i + 1});
    }
    for (int i = 0; i < 36; ++i)
    {
      points.emplace_back(i % 6, i / 6);
    }
    const PlanarTriangulation plane = triangulatePlane(points, segments);
    expectCoversHull(points, plane);
    const std::vector<Index> expected = naiveRegions(plane, points, segments);
    std::map<Index, Index> numbers{{0, 0}};
    for (std::size_t t = 0; t < expected.size(); ++t)
    {
      EXPECT_EQ(numbers.try_emplace(expected[t], plane.regions[t]).first->second, plane.regions[t]);
    }
    std::set<Index> used;
    std::ranges::for_each(numbers, [&](const auto& number) { used.insert(number.second); });
    EXPECT_EQ(used.size(), numbers.size());
    EXPECT_EQ(plane.regionCount, numbers.size());
    EXPECT_EQ(*used.rbegin() + 1, plane.regionCount);
    most = std::max(most, plane.regionCount);
  }
  EXPECT_GT(most, 3u);
}

} // namespace
