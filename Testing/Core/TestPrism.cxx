// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/WindDomain.h"
#include "Grid/Prism.h"
#include "LatticeSamples.h"
#include "Support/Error.h"
#include "Support/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace {

using atria::boundsAlong;
using atria::Box3;
using atria::Index;
using atria::isUprightSide;
using atria::PlacedBox;
using atria::PlacedPrism;
using atria::Placement;
using atria::PrismSide;
using atria::SideBits;
using atria::sideNumbers;
using atria::Vec2;
using atria::Vec3;
using atria::testing::Random;

constexpr double rounding = 1e-12;
const Box3 box{Vec3(-3.1, 0.7, 1.0), Vec3(5.3, 9.9, 4.0)};

SideBits bit(const PrismSide& side) { return SideBits{1} << side.number; }

TEST(Prism, OfFourSidesIsTheBoxToTheBit)
{
  const PlacedPrism prism(PlacedBox{{}, box});
  ASSERT_TRUE(prism.isBox());
  for (const PrismSide& side : prism.sides())
  {
    const int axis = atria::axisOf(static_cast<int>(side.number));
    const bool isUpper = atria::isUpper(static_cast<int>(side.number));
    EXPECT_EQ(side.normal, (isUpper ? 1.0 : -1.0) * Vec2::Unit(axis));
    EXPECT_EQ(side.foot({1.2345, 6.789})[axis], (isUpper ? box.max : box.min)[axis]);
    EXPECT_EQ(side.foot({1.2345, 6.789})[1 - axis], axis == 0 ? 6.789 : 1.2345);
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-20.0, 20.0);
  for (int i = 0; i < 100; ++i)
  {
    const Vec3 p(unit(random), unit(random), 2.0);
    const Vec2 clamped = p.head<2>().cwiseMax(box.min.head<2>()).cwiseMin(box.max.head<2>());
    EXPECT_EQ(prism.nearest(p.head<2>(), 0), clamped);
    EXPECT_EQ(prism.contains(p), PlacedBox(prism).contains(p));
  }
}

TEST(Prism, FillsItsBoundsWithARegularPolygon)
{
  for (const int count : {3, 5, 6, 8, 16, 31, 48})
  {
    const PlacedPrism prism(PlacedBox{atria::Placement(20.0), box}, count);
    Box3 bounds;
    for (std::size_t i = 0; i < prism.sides().size(); ++i)
    {
      const PrismSide& side = prism.sides()[i];
      const PrismSide& next = prism.sides()[(i + 1) % prism.sides().size()];
      EXPECT_EQ(side.number, atria::firstPrismSide + i);
      EXPECT_EQ(side.end, next.start);
      EXPECT_GT(side.normal[0] * next.normal[1] - side.normal[1] * next.normal[0], 0.0) << "convex";
      bounds.extend({side.start[0], side.start[1], 2.0});
    }
    EXPECT_EQ(bounds.min.head<2>(), box.min.head<2>());
    EXPECT_EQ(bounds.max.head<2>(), box.max.head<2>());
    EXPECT_NEAR((prism.sides()[0].normal + Vec2::UnitX()).norm(), 0.0, rounding);
    EXPECT_LT(prism.volume(), box.size().prod());
    EXPECT_TRUE(prism.contains(prism.axes.toModel(box.center())));
  }
}

TEST(Prism, AboutACircleTouchesItWithAllSides)
{
  const Vec2 center(3.0, -2.0);
  for (const int count : {3, 4, 5, 8, 17})
  {
    const Box3 bounds = atria::boundsAboutCircle(center, 7.0, count, 0.0, 1.0);
    const PlacedPrism prism(PlacedBox{{}, bounds}, count);
    for (const PrismSide& side : prism.sides())
    {
      EXPECT_NEAR(side.beyond(center), -7.0, 1e-9) << count;
    }
  }
}

TEST(Prism, FindsTheNearestPlaceOnSides)
{
  const PlacedPrism prism(PlacedBox{{}, box}, 7);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> unit(-20.0, 20.0);
  for (int i = 0; i < 200; ++i)
  {
    const Vec2 p(unit(random), unit(random));
    const PrismSide& side = prism.sides()[static_cast<std::size_t>(i) % 7];
    const PrismSide& next = prism.sides()[static_cast<std::size_t>(i + 1) % 7];
    EXPECT_LE(prism.beyond(prism.nearest(p, 0)), 1e-9);
    const Vec2 on = prism.nearest(p, bit(side));
    EXPECT_NEAR(side.beyond(on), 0.0, 1e-9);
    EXPECT_LE(prism.beyond(on), 1e-9);
    for (const double share : {0.0, 0.3, 0.6, 1.0})
    {
      EXPECT_LE((on - p).norm(), (side.start + share * (side.end - side.start) - p).norm() + 1e-9);
    }
    EXPECT_EQ(prism.nearest(p, bit(side) | bit(next)), side.end);
  }
}

TEST(Prism, NamesItsSides)
{
  EXPECT_EQ(atria::sideName(atria::xMin), "xMin");
  EXPECT_EQ(atria::sideName(atria::firstPrismSide), "domainSide1");
  for (const char* name : {"xMin", "zMax", "domainSide1", "domainSide48"})
  {
    EXPECT_TRUE(atria::isSideName(name)) << name;
  }
  for (const char* name : {"", "domainSide", "domainSide0", "domainSide49", "domainSide1a", "domainSide01", "Wall"})
  {
    EXPECT_FALSE(atria::isSideName(name)) << name;
  }
}

/// Of corners along axes of their own.
PlacedPrism polygon(const std::vector<Vec2>& corners) { return {atria::Placement(20.0), corners, 1.0, 4.0}; }

const std::vector<Vec2> kite{{0.0, 0.0}, {5.0, -3.0}, {12.0, 0.0}, {5.0, 8.0}};

TEST(Prism, StandsOnAnyConvexPolygon)
{
  const PlacedPrism prism = polygon(kite);
  EXPECT_FALSE(prism.isBox());
  ASSERT_EQ(prism.sides().size(), 4u);
  EXPECT_EQ(prism.bounds.min, Vec3(0, -3, 1));
  EXPECT_EQ(prism.bounds.max, Vec3(12, 8, 4));
  EXPECT_NEAR(prism.volume(), 0.5 * 12.0 * 11.0 * 3.0, rounding);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const PrismSide& side = prism.sides()[i];
    EXPECT_EQ(side.number, atria::firstPrismSide + i);
    EXPECT_EQ(side.start, kite[i]);
    EXPECT_EQ(side.end, kite[(i + 1) % 4]);
    EXPECT_LT(prism.beyond(0.5 * (side.start + side.end) - 0.1 * side.normal), 0.0);
    EXPECT_NEAR(prism.beyond(0.5 * (side.start + side.end) + 0.1 * side.normal), 0.1, rounding);
  }
}

TEST(Prism, TurnsAClockwisePolygonRoundFromItsFirstCorner)
{
  const PlacedPrism prism = polygon({kite[0], kite[3], kite[2], kite[1]});
  const PlacedPrism wanted = polygon(kite);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(prism.sides()[i].start, wanted.sides()[i].start);
    EXPECT_EQ(prism.sides()[i].normal, wanted.sides()[i].normal);
  }
}

TEST(Prism, HasBoundsAlongOtherAxes)
{
  Random random(3);
  for (const int sides : {3, 4, 7})
  {
    const PlacedPrism prism(PlacedBox{Placement(random.in(0.0, 90.0)), {Vec3(1, -2, 3), Vec3(5, 9, 4)}}, sides);
    const Placement axes(random.in(-90.0, 90.0));
    Box3 wanted;
    for (const PrismSide& side : prism.sides())
    {
      for (const double height : {3.0, 4.0})
      {
        wanted.extend(axes.fromModel(prism.axes.toModel({side.end[0], side.end[1], height})));
      }
    }
    const Box3 bounds = boundsAlong(axes, prism);
    EXPECT_NEAR((bounds.min - wanted.min).norm() + (bounds.max - wanted.max).norm(), 0.0, rounding);
  }
}

TEST(Prism, HasUprightSidesButForBottomAndTop)
{
  for (Index number = 0; number < sideNumbers; ++number)
  {
    EXPECT_EQ(isUprightSide(number), number != 4 && number != 5) << number;
  }
}

TEST(PrismError, PolygonsThatAreNotConvexNameTheCorner)
{
  const auto errorOf = [](const std::vector<Vec2>& corners) {
    try
    {
      polygon(corners);
    }
    catch (const atria::Error& error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto expect = [&](const std::vector<Vec2>& corners, const std::string& part) {
    EXPECT_NE(errorOf(corners).find(part), std::string::npos) << errorOf(corners);
  };
  EXPECT_EQ(errorOf(kite), "");
  expect({{0, 0}, {4, 0}, {1, 1}, {0, 4}}, "not convex at corner 3 (1, 1)");
  expect({{0, 4}, {1, 1}, {4, 0}, {0, 0}}, "not convex at corner 2 (1, 1)"); // clockwise
  expect({{0, 0}, {4, 0}, {4, 4}, {0, 0}}, "corner 4 (0, 0) repeats corner 1");
  expect({{0, 0}, {4, 0}, {4, 0}, {4, 4}}, "corner 3 (4, 0) repeats corner 2");
  expect({{0, 0}, {2, 0}, {4, 0}, {4, 4}}, "at corner 2 (2, 0) its sides go straight on");
  expect({{0, 0}, {4, 0}, {1, 0.01}, {2, 3}}, "corner 2 (4, 0) its sides fold back");
  expect({{0, 0}, {4, 4}, {4, 0}, {0, 4}}, "not convex at corner"); // a bow tie
  std::vector<Vec2> star;
  for (int i = 0; i < 5; ++i)
  {
    const double angle = 4.0 * std::numbers::pi * i / 5.0;
    star.emplace_back(std::cos(angle), std::sin(angle));
  }
  expect(star, "more than once");
  expect({{0, 0}, {4, 0}}, "3 to 48");
  expect({{0, 0}, {4, 0}, {std::nan(""), 4}}, "no number");
}

TEST(PrismError, NumberOfSides)
{
  EXPECT_THROW(PlacedPrism(PlacedBox{{}, box}, 2), atria::Error);
  EXPECT_THROW(PlacedPrism(PlacedBox{{}, box}, 49), atria::Error);
}

/// Of H = 10: the sides are 15 H from the circle that holds the building, also where the blockage asks for more.
TEST(WindDomain, ForWindFromAllAroundKeepsItsDistanceOnAllSides)
{
  for (const double width : {4.0, 60.0})
  {
    atria::TriangleSurface surface;
    const Box3 house{Vec3(100, 200, 0), Vec3(100 + width, 206, 10)};
    atria::testing::addBox(surface, "House", house);
    for (const int count : {5, 16})
    {
      const atria::WindDomain wind = atria::windDomain(surface, {{0}}, 33.0, count);
      const PlacedPrism prism(wind.box, count);
      double nearest = 1e9;
      for (const Vec3& p : surface.points)
      {
        nearest = std::min(nearest, -prism.beyond(prism.axes.fromModel(p).head<2>()));
      }
      EXPECT_GE(nearest, 150.0 * wind.widened - 1e-6);
      EXPECT_NEAR(prism.bounds.max[2], 10.0 + 50.0 * wind.widened, 1e-9);
      for (const PrismSide& side : prism.sides())
      {
        // Across the wind that is square to this side.
        const atria::Placement axes(33.0 + std::atan2(side.normal[1], side.normal[0]) * 180.0 / std::numbers::pi);
        const double section = atria::boundsAlong(axes, prism).size()[1] * prism.bounds.size()[2];
        EXPECT_LE(atria::frontalArea(surface, {0}, axes, 0.0) / section, 0.03 + 1e-9);
      }
    }
  }
}

} // namespace
