// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests turned axes and turned boxes.
#include "Grid/Placement.h"
#include "LatticeSamples.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace {

using namespace atria;
using atria::testing::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;

TEST(Placement, TurnsCounterclockwise)
{
  Random random(1);
  for (int round = 0; round < 200; ++round)
  {
    const double degrees = random.in(-800.0, 800.0);
    const double angle = degrees * std::numbers::pi / 180.0;
    const Placement placement(degrees);
    const Vec3 p = random.vector(10.0);
    const Vec3 xAxis(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 yAxis(-std::sin(angle), std::cos(angle), 0.0);
    EXPECT_NEAR((placement.toModel(p) - (p[0] * xAxis + p[1] * yAxis + p[2] * Vec3::UnitZ())).norm(), 0.0, rounding);
    EXPECT_NEAR((placement.fromModel(p) - Vec3(xAxis.dot(p), yAxis.dot(p), p[2])).norm(), 0.0, rounding);
    EXPECT_NEAR(std::remainder(placement.angle() - degrees, 360.0), 0.0, 1e-9);
    EXPECT_LE(std::abs(placement.angle()), 180.0);
  }
}

TEST(Placement, MakesQuarterTurnsExactly)
{
  const Vec3 p(0.1, 1.0 / 3.0, 0.7);
  const std::array<Vec3, 4> turned{p, Vec3(-p[1], p[0], p[2]), Vec3(-p[0], -p[1], p[2]), Vec3(p[1], -p[0], p[2])};
  for (int quarters = -9; quarters <= 9; ++quarters)
  {
    const Placement placement(90.0 * quarters);
    const Vec3& wanted = turned.at(static_cast<std::size_t>(quarters + 12) % 4);
    EXPECT_EQ(placement.toModel(p), wanted) << quarters;
    EXPECT_EQ(placement.fromModel(wanted), p) << quarters;
  }
}

TEST(Placement, TurnsBeyondAQuarterToTheSameBits)
{
  const Vec3 p(0.1, 1.0 / 3.0, 0.7);
  for (const double degrees : {10.0, -25.0, 44.0})
  {
    const Vec3 turned = Placement(degrees).toModel(p);
    EXPECT_EQ(Placement(degrees + 90.0).toModel(p), Vec3(-turned[1], turned[0], turned[2]));
    EXPECT_EQ(Placement(degrees - 90.0).toModel(p), Vec3(turned[1], -turned[0], turned[2]));
    EXPECT_EQ(Placement(degrees + 180.0).toModel(p), Vec3(-turned[0], -turned[1], turned[2]));
  }
}

TEST(Placement, OfNoAngleChangesNoBit)
{
  const Vec3 p(-0.0, 1e-320, infinity);
  for (const Placement& placement : {Placement(), Placement(0.0), Placement(-720.0)})
  {
    EXPECT_EQ(placement.angle(), 0.0);
    EXPECT_EQ(placement.fromModel(p), p);
    EXPECT_EQ(placement.toModel(p), p);
    EXPECT_TRUE(std::signbit(placement.toModel(p)[0]));
    EXPECT_TRUE(std::signbit(placement.fromModel(p)[0]));
  }
}

TEST(PlacedBox, ContainsItsBoundary)
{
  const PlacedBox box{Placement(90.0), {Vec3(1, 2, 3), Vec3(4, 6, 8)}}; // x is the model's y, y its -x
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const bool upper : {false, true})
    {
      Vec3 p = box.bounds.center();
      p[axis] = upper ? box.bounds.max[axis] : box.bounds.min[axis];
      EXPECT_TRUE(box.contains(box.axes.toModel(p)));
      p[axis] += upper ? 1e-9 : -1e-9;
      EXPECT_FALSE(box.contains(box.axes.toModel(p)));
    }
  }
  EXPECT_TRUE(box.contains({-5.9, 1.1, 3.5}));
  EXPECT_FALSE(box.contains({1.1, 5.9, 3.5}));
}

TEST(PlacedBox, IsTurnedAboutItsMiddle)
{
  Random random(2);
  for (int round = 0; round < 50; ++round)
  {
    const Vec3 low = random.vector(20.0);
    const Box3 box{low, low + random.vector(5.0).cwiseAbs()};
    const PlacedBox turned = turnedAboutMiddle(box, random.in(-400.0, 400.0));
    EXPECT_NEAR((turned.axes.toModel(turned.bounds.center()) - box.center()).norm(), 0.0, 1e-10);
    EXPECT_NEAR((turned.bounds.size() - box.size()).norm(), 0.0, 1e-10);
  }
  EXPECT_NEAR(turnedAboutMiddle({Vec3(1, 0, 0), Vec3(3, 1, 1)}, 25.0).axes.angle(), 25.0, rounding);
}

TEST(PlacedBox, ThatIsNotTurnedOrEmptyStaysAsItIs)
{
  const Box3 box{Vec3(0.1, 0.2, 0.3), Vec3(0.7, 1.9, 2.3)};
  EXPECT_EQ(turnedAboutMiddle(box, 360.0).bounds.min, box.min);
  EXPECT_EQ(turnedAboutMiddle(box, 0.0).bounds.max, box.max);
  EXPECT_TRUE(turnedAboutMiddle(Box3(), 30.0).bounds.empty());
}

} // namespace
