// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests exact predicates on points of the lattice, some of them shifted symbolically.
#include "Grid/Predicates.h"
#include "LatticeSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

namespace {

using namespace atria;
using atria::testing::pointsOf;
using atria::testing::Random;

/// Determinant by the rule of Sarrus.
Wide determinant(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
{
  return Wide(a[0]) * b[1] * c[2] + Wide(a[1]) * b[2] * c[0] + Wide(a[2]) * b[0] * c[1] - Wide(a[2]) * b[1] * c[0] -
         Wide(a[0]) * b[2] * c[1] - Wide(a[1]) * b[0] * c[2];
}

LatticePoint minus(const LatticePoint& a, const LatticePoint& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

LatticePoint unit(int axis)
{
  LatticePoint p{0, 0, 0};
  p[axis] = 1;
  return p;
}

/// The real configuration that the symbolic shift stands for, for coordinates of a few units: all are scaled by 10^9,
/// and grid points are shifted by 10^6, 10^3 and 1.
LatticePoint scaled(const LatticePoint& p)
{
  constexpr std::int64_t scale = 1000000000;
  return {scale * p[0], scale * p[1], scale * p[2]};
}

LatticePoint shifted(const LatticePoint& p)
{
  const LatticePoint at = scaled(p);
  return {at[0] + 1000000, at[1] + 1000, at[2] + 1};
}

/// Side of a line, seen against `axis`, on which the shifted grid point is.
int realSideOfLine(const LatticePoint& a, const LatticePoint& b, const LatticePoint& p, int axis)
{
  return signOf(determinant(minus(scaled(b), scaled(a)), minus(shifted(p), scaled(a)), unit(axis)));
}

int realSideOfSegment(const LatticePoint& p, const LatticePoint& q, const LatticePoint& a, const LatticePoint& b)
{
  const LatticePoint from = shifted(p);
  return signOf(determinant(minus(scaled(a), from), minus(scaled(b), from), minus(shifted(q), from)));
}

bool areEqualAndNotZero(const std::array<int, 3>& signs)
{
  return signs[0] != 0 && signs[0] == signs[1] && signs[1] == signs[2];
}

TEST(Predicates, KnowTheSignsOfNumbersBeyondSixtyFourBits)
{
  const Wide large = Wide(1) << 100;
  EXPECT_EQ(signOf(0), 0);
  EXPECT_EQ(signOf(large), 1);
  EXPECT_EQ(signOf(-large), -1);
  EXPECT_EQ(signOf(Wide(1) << 64), 1);
}

TEST(Predicates, ProjectAreasAlongAxes)
{
  const LatticePoint origin{0, 0, 0};
  EXPECT_EQ(signOf(projectedArea(origin, {1, 0, 5}, {0, 1, -5}, 2)), 1) << "x to y is counterclockwise from above";
  Random random(6);
  for (int round = 0; round < 300; ++round)
  {
    const LatticePoint a = random.point(-9, 9);
    const LatticePoint b = random.point(-9, 9);
    const LatticePoint c = random.point(-9, 9);
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_TRUE(projectedArea(a, b, c, axis) == determinant(minus(b, a), minus(c, a), unit(axis)));
    }
  }
}

TEST(Predicates, FindTheSideOfALineOfShiftedPoints)
{
  const std::vector<LatticePoint> points = pointsOf(0, 2);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const LatticePoint& a : points)
    {
      for (const LatticePoint& b : points)
      {
        const bool isOnePoint = a[(axis + 1) % 3] == b[(axis + 1) % 3] && a[(axis + 2) % 3] == b[(axis + 2) % 3];
        for (const LatticePoint& p : points)
        {
          const int side = sideOfLine(a, b, p, axis);
          ASSERT_EQ(side, realSideOfLine(a, b, p, axis));
          ASSERT_EQ(side == 0, isOnePoint);
        }
      }
    }
  }
}

TEST(Predicates, FindTheSideOfAPlaneOfShiftedPoints)
{
  Random random(7);
  for (int round = 0; round < 30000; ++round)
  {
    const LatticePoint a = random.point(0, 2);
    const LatticePoint b = random.point(0, 2);
    const LatticePoint c = random.point(0, 2);
    const LatticePoint p = random.point(0, 2);
    const LatticeNormal normal(a, b, c);
    const Wide volume =
        determinant(minus(scaled(b), scaled(a)), minus(scaled(c), scaled(a)), minus(shifted(p), scaled(a)));
    const bool hasNoArea = normal.n == std::array<Wide, 3>{0, 0, 0};
    ASSERT_EQ(normal.sideOf(a, p), signOf(volume));
    ASSERT_EQ(normal.sideOf(a, p) == 0, hasNoArea);
  }
}

TEST(Predicates, FindTheSideOfALineOnWhichAShiftedLinePasses)
{
  Random random(8);
  for (int round = 0; round < 30000; ++round)
  {
    const LatticePoint p = random.point(0, 2);
    const LatticePoint q = random.point(0, 2);
    const LatticePoint a = random.point(0, 2);
    const LatticePoint b = random.point(0, 2);
    const int side = sideOfSegment(p, q, a, b);
    ASSERT_EQ(side, realSideOfSegment(p, q, a, b));
    const LatticeNormal parallel({0, 0, 0}, minus(q, p), minus(b, a));
    const bool isParallel = parallel.n == std::array<Wide, 3>{0, 0, 0};
    ASSERT_EQ(side == 0, isParallel);
  }
}

TEST(Predicates, FindTheTrianglesThatShiftedLinesMeet)
{
  Random random(9);
  for (int round = 0; round < 20000; ++round)
  {
    const LatticePoint a = random.point(0, 3);
    const LatticePoint b = random.point(0, 3);
    const LatticePoint c = random.point(0, 3);
    const LatticePoint p = random.point(0, 3);
    const LatticePoint q = random.point(0, 3);
    ASSERT_EQ(lineMeetsTriangle(a, b, c, p, q),
              areEqualAndNotZero(
                  {realSideOfSegment(p, q, a, b), realSideOfSegment(p, q, b, c), realSideOfSegment(p, q, c, a)}));
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool meets = lineMeetsTriangle(a, b, c, p, axis);
      ASSERT_EQ(meets, areEqualAndNotZero({realSideOfLine(a, b, p, axis), realSideOfLine(b, c, p, axis),
                                           realSideOfLine(c, a, p, axis)}));
      const LatticePoint along = minus(p, minus({0, 0, 0}, unit(axis)));
      ASSERT_EQ(meets, lineMeetsTriangle(a, b, c, p, along)) << "the line is the same";
    }
  }
}

TEST(Predicates, LetLinesCrossAClosedSurfaceTwiceOrNot)
{
  Random random(10);
  for (int round = 0; round < 300; ++round)
  {
    std::array<LatticePoint, 4> t;
    std::ranges::generate(t, [&] { return random.point(0, 2); });
    const auto crossings = [&](const LatticePoint& p, const auto& along) {
      return int(lineMeetsTriangle(t[0], t[1], t[2], p, along)) + int(lineMeetsTriangle(t[0], t[3], t[1], p, along)) +
             int(lineMeetsTriangle(t[1], t[3], t[2], p, along)) + int(lineMeetsTriangle(t[2], t[3], t[0], p, along));
    };
    for (const LatticePoint& p : pointsOf(0, 2))
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        ASSERT_EQ(crossings(p, axis) % 2, 0);
      }
      ASSERT_EQ(crossings(p, random.point(0, 2)) % 2, 0);
    }
  }
}

/// Axis i of the result is axis i - `turn` of the point.
LatticePoint turnedAxes(const LatticePoint& p, std::size_t turn)
{
  return {p[(3 - turn) % 3], p[(4 - turn) % 3], p[(5 - turn) % 3]};
}

TEST(Predicates, AreExactForTheLargestDifferences)
{
  // Rows of determinant -1: a product that is rounded or cut off changes the sign or the value.
  constexpr std::int64_t most = (std::int64_t{1} << 40) - 1;
  for (std::size_t turn = 0; turn < 3; ++turn)
  {
    const int axis = static_cast<int>(turn + 2) % 3;
    const LatticePoint a{-most / 2, -most / 2, -most / 2};
    const auto from = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      return turnedAxes({a[0] + x, a[1] + y, a[2] + z}, turn);
    };
    const LatticePoint b = from(most, most - 1, 0);
    const LatticePoint c = from(most - 1, most - 2, 0);
    const LatticePoint p = from(most, most - 1, 1);
    EXPECT_TRUE(projectedArea(a, b, c, axis) == -1);
    EXPECT_EQ(sideOfLine(a, b, c, axis), -1);
    for (const auto& [q, r, s] : {std::array{b, c, p}, std::array{c, p, b}, std::array{p, b, c}})
    {
      EXPECT_EQ(LatticeNormal(a, q, r).sideOf(a, s), -1);
      EXPECT_EQ(LatticeNormal(a, r, q).sideOf(a, s), 1);
      EXPECT_EQ(sideOfSegment(a, s, q, r), -1);
      EXPECT_EQ(sideOfSegment(a, s, r, q), 1);
    }
  }
}

} // namespace
