// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests unions of two polygons, and the shapes of polygons.
#include "Quality/Faces/Geometry.h"
#include "Quality/Unions/PolygonUnion.h"
#include "UpTo.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

namespace {

using namespace atria;
using atria::testing::upTo;
using Loop = std::vector<Index>;

const std::vector<Vec3> unitSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(PolygonUnion, FindsEdgesThatRunBothWays)
{
  EXPECT_TRUE(shareAnEdge(Loop{0, 1, 2}, Loop{1, 0, 3}));
  EXPECT_TRUE(shareAnEdge(Loop{0, 1, 2}, Loop{0, 2, 3}));
  EXPECT_FALSE(shareAnEdge(Loop{0, 1, 2}, Loop{0, 1, 3})) << "in the same direction";
  EXPECT_FALSE(shareAnEdge(Loop{0, 1, 2, 3}, Loop{0, 4, 2})) << "the points are no neighbors";
  EXPECT_FALSE(shareAnEdge(Loop{0, 1, 2}, Loop{}));
  EXPECT_TRUE(atria::contains(Loop{3, 5}, 5));
  EXPECT_FALSE(atria::contains(Loop{3, 5}, 4));
  EXPECT_FALSE(atria::contains(Loop{}, 0));
}

TEST(PolygonUnion, GoesAroundBothFromAnyStart)
{
  // A hexagon and a pentagon that share one, two or three edges in a row.
  for (std::size_t shared = 1; shared <= 3; ++shared)
  {
    Loop a = upTo(6);
    Loop b(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(shared) + 1);
    std::ranges::reverse(b);
    b.insert(b.end(), {10, 11});
    Loop expected(a.begin() + static_cast<std::ptrdiff_t>(shared), a.end());
    expected.insert(expected.end(), {0, 10, 11});
    const auto fromLowest = [](Loop loop) {
      std::ranges::rotate(loop, std::ranges::min_element(loop));
      return loop;
    };
    for (std::size_t start = 0; start < 30; ++start)
    {
      std::ranges::rotate(a, a.begin() + 1);
      std::ranges::rotate(b, b.begin() + (start % 6 == 0 ? 1 : 0));
      EXPECT_EQ(fromLowest(unite(a, b).value()), fromLowest(expected));
      EXPECT_EQ(fromLowest(unite(b, a).value()), fromLowest(expected));
      EXPECT_TRUE(shareOneRun(a, b));
    }
  }
}

TEST(PolygonUnion, IsNoneWithoutOneRunOfEdges)
{
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{4, 5, 6}), std::nullopt) << "nothing is shared";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 4, 5}), std::nullopt) << "a point is";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 0, 5, 3, 2, 4}), std::nullopt) << "two runs are";
  EXPECT_EQ(unite(Loop{0, 1, 2, 3}, Loop{1, 0, 4, 3}), std::nullopt) << "a point would be there twice";
  EXPECT_EQ(unite(Loop{0, 1, 2}, Loop{2, 1, 0}), std::nullopt) << "all edges are shared";
}

TEST(PolygonUnion, PointsInOneRunFollowEachOtherInBoth)
{
  const auto share = [](const Loop& a, const Loop& b) { return shareOneRun(a, b); };
  EXPECT_TRUE(share({0, 1, 2, 3}, {4, 5, 6}));
  EXPECT_TRUE(share({0, 1, 2, 3}, {1, 5, 6}));
  EXPECT_TRUE(share({0, 1, 2, 3}, {3, 0, 6}));
  EXPECT_FALSE(share({0, 1, 2, 3}, {0, 2, 6})) << "not in the first";
  EXPECT_FALSE(share({0, 1, 6}, {0, 4, 1, 5})) << "not in the second";
  EXPECT_FALSE(share({0, 1, 2}, {2, 1, 0})) << "neither has other points";
  EXPECT_FALSE(share({0, 1, 2, 3}, {2, 1, 0})) << "the second has no other points";
}

TEST(PolygonShapes, AreCoplanarUpToAnAngle)
{
  constexpr double sine = 0.01;
  for (const double factor : {0.0, 0.99, 1.01})
  {
    const double tilt = std::asin(factor * sine);
    std::vector<Vec3> points = unitSquare;
    points.insert(points.end(),
                  {Vec3(1 + std::cos(tilt), 0, std::sin(tilt)), Vec3(1 + std::cos(tilt), 1, std::sin(tilt))});
    EXPECT_EQ(coplanar(points, Loop{0, 1, 2, 3}, Loop{1, 4, 5, 2}, sine), factor < 1.0) << factor;
    EXPECT_FALSE(coplanar(points, Loop{0, 1, 2, 3}, Loop{2, 5, 4, 1}, sine)) << "they face each other";
  }
}

TEST(PolygonShapes, AreCoplanarUpToADistance)
{
  constexpr double sine = 0.01;
  for (const double factor : {0.99, 1.01})
  {
    // Both are half of their distance away from the plane between them; the longest edge is 3.
    const double step = factor * 2.0 * 3.0 * sine;
    std::vector<Vec3> points = unitSquare;
    points.insert(points.end(), {Vec3(1, 0, step), Vec3(4, 0, step), Vec3(4, 1, step), Vec3(1, 1, step)});
    EXPECT_EQ(coplanar(points, Loop{0, 1, 2, 3}, Loop{4, 5, 6, 7}, sine), factor < 1.0) << factor;
    EXPECT_EQ(coplanar(points, Loop{4, 5, 6, 7}, Loop{0, 1, 2, 3}, sine), factor < 1.0) << factor;
  }
}

TEST(PolygonShapes, AreStarShapedFromFarEnoughBehind)
{
  constexpr double sine = 0.1;
  std::vector<Vec3> square = unitSquare;
  std::ranges::for_each(square, [](Vec3& p) { p *= 2.0; }); // the root of its area is 2
  const auto isStar = [&](double z) { return isStarShaped(square, upTo(4), Vec3(0.5, 1.5, z), sine); };
  EXPECT_TRUE(isStar(-0.201));
  EXPECT_FALSE(isStar(-0.199));
  EXPECT_FALSE(isStar(0.0));
  EXPECT_FALSE(isStar(0.3)) << "seen from its front";
}

TEST(PolygonShapes, AreStarShapedIfTheCentroidAndAPointSeeAllEdges)
{
  struct Case
  {
    std::vector<Vec3> points;
    bool isStar;
    const char* why;
  };
  const std::vector<Case> cases{
      {{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}}, true, "the inner corner sees all of an L"},
      {{{0, 0, 0}, {9, 0, 0}, {9, 1, 0}, {1, 1, 0}, {1, 9, 0}, {0, 9, 0}}, false, "the centroid lies outside"},
      {{{3, -1, 0},
        {3, 1, 0},
        {1, 1, 0},
        {1, 3, 0},
        {-1, 3, 0},
        {-1, 1, 0},
        {-3, 1, 0},
        {-3, -1, 0},
        {-1, -1, 0},
        {-1, -3, 0},
        {1, -3, 0},
        {1, -1, 0}},
       false,
       "no corner of a cross sees the sides of all its arms"},
      {{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {3.9, 2, 0}}, false, "a dent hides edges from the centroid"}};
  for (const Case& one : cases)
  {
    for (std::size_t start = 0; start < one.points.size(); ++start)
    {
      Loop loop = upTo(one.points.size());
      std::ranges::rotate(loop, loop.begin() + static_cast<std::ptrdiff_t>(start));
      EXPECT_EQ(isStarShaped(one.points, loop, Vec3(0.5, 0.5, -3), 1e-6), one.isStar) << one.why;
    }
  }
}

TEST(PolygonShapes, HaveTheSmallestTetrahedronOfAFan)
{
  // Of a square the triangles around the centroid are half as large as those of a corner.
  const Vec3 below(0.2, 0.7, -3.0);
  for (const double side : {1.0, 2.0})
  {
    std::vector<Vec3> square = unitSquare;
    std::ranges::for_each(square, [&](Vec3& p) { p *= side; });
    const auto least = [&](const Vec3* beyond) { return leastTetrahedron(square, upTo(4), below, beyond); };
    const double expected = 3.0 / 12.0 / side; // of the cube of the root of the area
    EXPECT_NEAR(least(nullptr), expected, 1e-12);
    for (const double height : {2.0, 4.0, -1.0})
    {
      const Vec3 above(0.1, 0.1, height);
      EXPECT_NEAR(least(&above), std::min(expected, height / (height > 0.0 ? 12.0 : 6.0) / side), 1e-12) << height;
    }
  }
}

/// Twice the area of a triangle in the plane z = 0, positive if it is counterclockwise.
double twiceArea(const Vec3& a, const Vec3& b, const Vec3& c) { return (b - a).cross(c - a)[2]; }

TEST(PolygonShapes, TakeTheBestCornerForTheSmallestTetrahedron)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(0.0, 0.9);
  for (std::size_t round = 0; round < 100; ++round)
  {
    const std::size_t size = 3 + round % 6;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < size; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) + some(random)) / static_cast<double>(size);
      points.emplace_back(2.0 * std::cos(angle), std::sin(angle), 0.0);
    }
    const PolygonMeasure face = measurePolygon(points, upTo(size));
    double best = -1.0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < size; ++i)
    {
      least = std::min(least, twiceArea(points[i], points[(i + 1) % size], face.centroid));
      double ofCorner = std::numeric_limits<double>::infinity();
      for (std::size_t k = 1; k + 1 < size; ++k)
      {
        ofCorner = std::min(ofCorner, twiceArea(points[i], points[(i + k) % size], points[(i + k + 1) % size]));
      }
      best = std::max(best, ofCorner);
    }
    const double expected = std::min(best, least) / 6.0 / std::pow(face.area[2], 1.5);
    EXPECT_NEAR(leastTetrahedron(points, upTo(size), Vec3(0.1, 0.2, -1), nullptr), expected, 1e-12) << round;
    const Vec3 above(0.3, 0.1, 0.5);
    EXPECT_NEAR(leastTetrahedron(points, upTo(size), Vec3(0.1, 0.2, -1), &above), 0.5 * expected, 1e-12) << round;
  }
}

} // namespace
