// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the sides of planes on which triangles lie, against exact volumes.
#include "Draw.h"
#include "Grid/Predicates.h"
#include "RepairSamples.h"
#include "Surface/Repair/PlaneSides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace atria;
using atria::testing::addTriangle;
using atria::testing::areaOf;
using atria::testing::Draw;

/// The volume that p spans with a triangle; positive on its front.
Wide volumeOf(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c, const LatticePoint& p)
{
  const auto minus = [&](const LatticePoint& q) { return std::array<Wide, 3>{q[0] - a[0], q[1] - a[1], q[2] - a[2]}; };
  const std::array<Wide, 3> u = minus(b);
  const std::array<Wide, 3> v = minus(c);
  const std::array<Wide, 3> w = minus(p);
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
}

Wide volumeOf(const TriangleSoup& soup, Index t, const LatticePoint& p)
{
  return volumeOf(soup.corner(t, 0), soup.corner(t, 1), soup.corner(t, 2), p);
}

/// Compares the sides of triangle 1 as seen from triangle 0 with exact ones.
void expectSides(const TriangleSoup& soup, double reach)
{
  const PlaneSides sides(soup, 1, 0, reach);
  const double length = areaOf(soup, 0).norm();
  int above = 0;
  int below = 0;
  int shared = 0;
  for (int i = 0; i < 3; ++i)
  {
    const Wide exact = volumeOf(soup, 0, soup.corner(1, i));
    EXPECT_TRUE(sides.exact(i) == exact);
    EXPECT_EQ(sides.sign(i), signOf(exact));
    const double distance = length > 0.0 ? static_cast<double>(exact) / length : 0.0;
    EXPECT_NEAR(sides.distance(i), distance, 0.0101);
    const bool isShared = contains(soup.triangles[0], soup.triangles[1].at(static_cast<std::size_t>(i)));
    shared += isShared ? 1 : 0;
    above += !isShared && distance > reach ? 1 : 0;
    below += !isShared && distance < -reach ? 1 : 0;
  }
  EXPECT_EQ(sides.apart(), shared < 3 && (above + shared == 3 || below + shared == 3));
}

TEST(PlaneSides, AreExactInSmallSoups)
{
  Draw draw(1);
  for (int round = 0; round < 5000; ++round)
  {
    TriangleSoup soup;
    for (int i = 0; i < 6; ++i)
    {
      soup.points.push_back(draw.point(4));
    }
    soup.add(draw.triangle(6), 0, 0);
    soup.add(draw.triangle(6), 0, 1);
    if (!hasRepeatedPoint(soup.triangles[0]) && !hasRepeatedPoint(soup.triangles[1]))
    {
      expectSides(soup, 0.9071); // no distance is the limit
    }
  }
}

TEST(PlaneSides, AreExactOneUnitOffALargePlane)
{
  Draw draw(2);
  const std::int64_t far = std::int64_t{1} << 34;
  for (int round = 0; round < 3000; ++round)
  {
    const LatticePoint a = draw.point(far);
    const LatticePoint u = draw.point(far);
    LatticePoint v = draw.point(round % 2 == 0 ? far : 3);
    std::ranges::transform(u, v, v.begin(), [&](auto l, auto r) { return round % 2 == 0 ? r : l / 2 + r; });
    const auto at = [&](std::int64_t i, std::int64_t j) {
      return LatticePoint{a[0] + i * u[0] + j * v[0], a[1] + i * u[1] + j * v[1], a[2] + i * u[2] + j * v[2]};
    };
    TriangleSoup soup;
    addTriangle(soup, at(0, 0), at(8, 0), at(0, 8));
    addTriangle(soup, at(1, 2), at(5, 1), at(2, 9));
    for (int i = 3; i < 6; ++i)
    {
      soup.points[static_cast<std::size_t>(i)][i % 3] += draw.in(-1, 1);
    }
    const PlaneSides sides(soup, 1, 0, 4.0);
    for (int i = 0; i < 3; ++i)
    {
      const Wide exact = volumeOf(soup, 0, soup.corner(1, i));
      EXPECT_EQ(sides.sign(i), signOf(exact));
      EXPECT_TRUE(sides.exact(i) == exact);
      EXPECT_LT(std::abs(sides.distance(i)), 1.02);
    }
    EXPECT_FALSE(sides.apart());
  }
}

TEST(PlaneSides, OfATriangleWithoutAreaAreZero)
{
  TriangleSoup soup;
  addTriangle(soup, {0, 0, 0}, {10, 20, 30}, {20, 40, 60});
  addTriangle(soup, {5, 900, 0}, {7, 800, 1}, {-9, 500, 3});
  const PlaneSides sides(soup, 1, 0, 4.0);
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(sides.distance(i), 0.0);
    EXPECT_EQ(sides.sign(i), 0);
  }
  EXPECT_FALSE(sides.apart());
}

TEST(PlaneSides, AreApartBeyondTheReach)
{
  for (const std::int64_t height : {-11, -10, -9, 0, 9, 10, 11})
  {
    TriangleSoup soup;
    addTriangle(soup, {0, 0, 0}, {100, 0, 0}, {0, 100, 0});
    addTriangle(soup, {10, 10, height}, {20, 10, 20 * height}, {10, 20, 30 * height});
    EXPECT_EQ(PlaneSides(soup, 1, 0, 10.0).apart(), std::abs(height) > 10) << height;
    soup.triangles[1][0] = 0; // a common corner
    EXPECT_EQ(PlaneSides(soup, 1, 0, 10.0).apart(), height != 0) << height;
    soup.points[4] = {20, 10, -20 * height};
    EXPECT_FALSE(PlaneSides(soup, 1, 0, 10.0).apart()) << height;
  }
}

TEST(PlaneSides, PassageIsWhereTheEdgeMeetsThePlane)
{
  Draw draw(3);
  int passing = 0;
  for (int round = 0; round < 3000; ++round)
  {
    TriangleSoup soup;
    addTriangle(soup, draw.point(5000), draw.point(5000), draw.point(5000));
    addTriangle(soup, draw.point(5000), draw.point(5000), draw.point(5000));
    const PlaneSides sides(soup, 1, 0, 4.0);
    for (int i = 0; i < 3; ++i)
    {
      const int next = (i + 1) % 3;
      if (sides.sign(i) * sides.sign(next) >= 0)
      {
        continue;
      }
      const PlaneSides::Passage passage = sides.passage(i, next);
      const auto begin = static_cast<double>(sides.exact(i));
      const auto end = static_cast<double>(sides.exact(next));
      const Vec3 expected =
          toVector(soup.corner(1, i)) + begin / (begin - end) * between(soup.corner(1, i), soup.corner(1, next));
      EXPECT_LT((passage.at - expected).norm(), passage.error);
      EXPECT_LT((passage.at - expected).norm(), 1e-3) << "these planes meet the edges in definite points";
      const double rise = std::abs(sides.distance(i) - sides.distance(next));
      EXPECT_NEAR(passage.error * rise, 0.02 * between(soup.corner(1, i), soup.corner(1, next)).norm(), 1e-6);
      ++passing;
    }
  }
  EXPECT_GT(passing, 1000);
}

} // namespace
