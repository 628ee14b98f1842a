// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests nearest points of segments and triangles.
#include "Draw.h"
#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Draw;

/// True if x is the place nearest to p in the convex hull of some points, of which x is one: no way to a point leads
/// nearer.
bool isNearestIn(const std::vector<Vec3>& hull, const Vec3& p, const Vec3& x)
{
  return std::ranges::all_of(hull, [&](const Vec3& v) { return (p - x).dot(v - x) <= 1e-9; });
}

bool isOnSegment(const Vec3& x, const Vec3& a, const Vec3& b)
{
  return std::abs((x - a).norm() + (x - b).norm() - (b - a).norm()) < 1e-7;
}

bool isOnTriangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const auto area = [](const Vec3& u, const Vec3& v) { return u.cross(v).norm(); };
  const bool isInside =
      std::abs(area(a - x, b - x) + area(b - x, c - x) + area(c - x, a - x) - area(b - a, c - a)) < 1e-7;
  const bool isFlat = area(b - a, c - a) < 1e-9;
  return isFlat ? isOnSegment(x, a, b) || isOnSegment(x, b, c) || isOnSegment(x, c, a) : isInside;
}

TEST(Distance, NearestOnASegmentIsNearerThanAllOthers)
{
  Draw draw(10);
  for (int round = 0; round < 5000; ++round)
  {
    const Vec3 p = draw.vector(2.0);
    const Vec3 a = draw.vector(1.0);
    const Vec3 b = round % 10 == 0 ? a : draw.vector(1.0);
    const Vec3 x = nearestOnSegment(p, a, b);
    EXPECT_TRUE(isOnSegment(x, a, b));
    EXPECT_TRUE(isNearestIn({a, b}, p, x));
  }
}

/// Some triangles are long, obtuse, or lines or points.
std::array<Vec3, 3> drawTriangle(Draw& draw, int round)
{
  std::array<Vec3, 3> t{draw.vector(1.0), draw.vector(1.0), draw.vector(1.0)};
  switch (round % 8)
  {
    case 0:
      t[2] = t[0] + 0.25 * (t[1] - t[0]) + 0.05 * draw.vector(1.0);
      break;
    case 1:
      t = {Vec3(0, 0, 0), Vec3(0.5, 0.25, -1), Vec3(1, 0.5, -2)};
      std::ranges::rotate(t, t.begin() + draw.in(0, 2));
      break;
    case 2:
      t[1] = t[2] = t[0];
      break;
    default:
      break;
  }
  return t;
}

TEST(Distance, NearestOnATriangleIsNearerThanAllOthers)
{
  Draw draw(11);
  for (int round = 0; round < 8000; ++round)
  {
    const auto [a, b, c] = drawTriangle(draw, round);
    const Vec3 p = draw.vector(round % 3 == 0 ? 0.5 : 2.0);
    const Vec3 x = nearestOnTriangle(p, a, b, c);
    EXPECT_TRUE(isOnTriangle(x, a, b, c)) << round;
    EXPECT_TRUE(isNearestIn({a, b, c}, p, x)) << round;
  }
}

TEST(Distance, NearestOnATriangleIsExactAtCornersEdgesAndInside)
{
  const Vec3 a(0, 0, 0);
  const Vec3 b(4, 0, 0);
  const Vec3 c(0, 4, 0);
  const std::vector<std::pair<Vec3, Vec3>> places{
      {{1, 1, 5}, {1, 1, 0}},  {{1, 1, -5}, {1, 1, 0}}, {{-1, -1, 2}, a},       {{6, -1, 0}, b},        {{-1, 7, 0}, c},
      {{2, -3, 1}, {2, 0, 0}}, {{-3, 2, 1}, {0, 2, 0}}, {{4, 4, 1}, {2, 2, 0}}, {{2, 0, 0}, {2, 0, 0}}, {b, b}};
  for (const auto& [p, expected] : places)
  {
    EXPECT_LT((nearestOnTriangle(p, a, b, c) - expected).norm(), 1e-12);
    EXPECT_LT((nearestOnTriangle(p, c, b, a) - expected).norm(), 1e-12);
  }
}

TEST(Distance, PlacesAreTakenIfTheyAreNearerThanAllBefore)
{
  NearestPlace nearest{Vec3(1, 0, 0)};
  EXPECT_FALSE(nearest.found());
  EXPECT_FALSE(nearest.place().has_value());
  EXPECT_TRUE(nearest.offer({4, 0, 0}));
  EXPECT_TRUE(nearest.found());
  EXPECT_FALSE(nearest.offer({-2, 0, 0})) << "it is as near as the first";
  EXPECT_EQ(nearest.place(), Vec3(4, 0, 0));
  EXPECT_TRUE(nearest.offer({1, 2, 0}));
  EXPECT_FALSE(nearest.offer({1, 0, 2.5}));
  EXPECT_EQ(nearest.at, Vec3(1, 2, 0));
  EXPECT_EQ(nearest.squaredDistance, 4.0);
}

/// Each of the two places is the nearest to the other. The squared distance is convex, so that no pair is nearer.
void expectNearest(const NearestPair& pair, const std::vector<Vec3>& segment, const std::vector<Vec3>& other)
{
  EXPECT_TRUE(isOnSegment(pair.first, segment[0], segment[1]));
  EXPECT_TRUE(other.size() == 2 ? isOnSegment(pair.second, other[0], other[1])
                                : isOnTriangle(pair.second, other[0], other[1], other[2]));
  EXPECT_TRUE(isNearestIn(segment, pair.second, pair.first));
  EXPECT_TRUE(isNearestIn(other, pair.first, pair.second));
  EXPECT_EQ(pair.distance(), (pair.first - pair.second).norm());
}

TEST(Distance, NearestOfSegmentsIsNearerThanAllOtherPairs)
{
  Draw draw(12);
  for (int round = 0; round < 8000; ++round)
  {
    const Vec3 p = draw.vector(1.0);
    const Vec3 q = round % 11 == 0 ? p : draw.vector(1.0);
    const Vec3 a = draw.vector(1.0);
    const Vec3 parallel = a + draw.real(-2.0, 2.0) * (q - p);
    const Vec3 b = round % 7 == 0 ? a : (round % 5 == 0 ? parallel : draw.vector(1.0));
    SCOPED_TRACE(round);
    expectNearest(nearestOfSegments(p, q, a, b), {p, q}, {a, b});
  }
}

bool passesThrough(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 normal = (b - a).cross(c - a);
  const double ofP = normal.dot(p - a);
  const double ofQ = normal.dot(q - a);
  return ofP * ofQ <= 0.0 && isOnTriangle(p + ofP / (ofP - ofQ) * (q - p), a, b, c);
}

TEST(Distance, NearestOfASegmentAndATriangleIsNearerThanAllOtherPairs)
{
  Draw draw(13);
  int passing = 0;
  for (int round = 0; round < 8000; ++round)
  {
    const Vec3 p = draw.vector(1.5);
    const Vec3 q = draw.vector(1.5);
    const auto [a, b, c] = drawTriangle(draw, round);
    if (passesThrough(p, q, a, b, c))
    {
      ++passing;
      continue;
    }
    SCOPED_TRACE(round);
    expectNearest(nearestOfSegmentAndTriangle(p, q, a, b, c), {p, q}, {a, b, c});
  }
  EXPECT_LT(passing, 4000);
}

} // namespace
