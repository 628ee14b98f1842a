// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the parts of triangles in convex regions, and the areas of drawn surfaces in a domain.
#include "Audit/ClippedTriangles.h"
#include "Support/Shapes.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace atria;
using atria::testing::addSheet;
using atria::testing::addSurface;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using Corners = std::array<Vec3, 3>;

class RandomTriangles
{
public:
  explicit RandomTriangles(unsigned seed) : random(seed) {}
  Vec3 place() { return {some(random), some(random), some(random)}; }
  Corners triangle() { return {place(), place(), place()}; }

private:
  std::mt19937 random;
  std::uniform_real_distribution<double> some{-3.0, 3.0};
};

double areaOf(const Corners& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).norm(); }

ConvexRegion::Part within(const ConvexRegion& region, const Corners& t, double level = 0.0)
{
  return region.within(t[0], t[1], t[2], level);
}

/// Sums the parts of a triangle in regions.
ConvexRegion::Part sumOver(const std::vector<ConvexRegion>& regions, const Corners& t, double level)
{
  ConvexRegion::Part sum;
  for (const ConvexRegion& region : regions)
  {
    const ConvexRegion::Part part = within(region, t, level);
    sum.area += part.area;
    sum.heightTimesArea += part.heightTimesArea;
  }
  return sum;
}

TEST(ConvexRegion, OfBoxesSideBySideHaveAllOfATriangle)
{
  std::vector<ConvexRegion> boxes;
  for (int i = 0; i < 27; ++i)
  {
    const Vec3 place(i % 3, i / 3 % 3, i / 9);
    const Vec3 low = 3.0 * place - Vec3::Constant(4.0);
    boxes.emplace_back(Box3{low, low + Vec3::Constant(3.0)}, 0.0);
  }
  RandomTriangles triangles(3);
  for (int round = 0; round < 200; ++round)
  {
    const Corners t = triangles.triangle();
    const double level = 0.1 * round;
    const ConvexRegion::Part sum = sumOver(boxes, t, level);
    EXPECT_NEAR(sum.area, areaOf(t), 1e-11);
    EXPECT_NEAR(sum.heightTimesArea, areaOf(t) * ((t[0][2] + t[1][2] + t[2][2]) / 3.0 - level), 1e-9);
  }
}

TEST(ConvexRegion, HasWhatLiesWithinItsPlanes)
{
  struct Case
  {
    Corners corners;
    double area;
    double height;
  };
  const ConvexRegion region(Box3{Vec3(0, 0, 0), Vec3(2, 4, 6)}, 0.0);
  const double root = std::sqrt(2.0);
  const std::vector<Case> cases{
      {{Vec3(0.5, 1, 1), Vec3(1.5, 1, 1), Vec3(0.5, 3, 1)}, 1.0, 1.0},             // inside
      {{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 4, 0)}, 4.0, 0.0},                   // on the bottom
      {{Vec3(0, 0, 6), Vec3(2, 0, 6), Vec3(0, 4, 6)}, 4.0, 6.0},                   // on the top
      {{Vec3(-9, -9, 5), Vec3(99, -9, 5), Vec3(-9, 99, 5)}, 8.0, 5.0},             // covers a level
      {{Vec3(1, -99, -99), Vec3(1, 99, -99), Vec3(1, 0, 199)}, 24.0, 3.0},         // covers a plane x = 1
      {{Vec3(-99, 1, -99), Vec3(99, 1, -99), Vec3(0, 1, 199)}, 12.0, 3.0},         // covers a plane y = 1
      {{Vec3(-1, 1, 2), Vec3(1, 1, 2), Vec3(-1, 3, 2)}, 0.5, 2.0},                 // its middle is on a side
      {{Vec3(-99, -99, -99), Vec3(99, -99, 99), Vec3(0, 99, 0)}, 8.0 * root, 1.0}, // covers a plane z = x
      {{Vec3(-1, 1, 2), Vec3(-2, 1, 2), Vec3(-1, 3, 2)}, 0.0, 0.0},                // outside
      {{Vec3(1, 1, -1), Vec3(1.5, 1, -1), Vec3(1, 3, -0.1)}, 0.0, 0.0},            // below
      {{Vec3(3, 3, 3), Vec3(1, 6, 3), Vec3(3, 6, 3)}, 0.0, 0.0}};                  // past an edge
  for (std::size_t i = 0; i < cases.size(); ++i)
  {
    for (std::size_t start = 0; start < 3; ++start)
    {
      Corners t = cases[i].corners;
      std::ranges::rotate(t, t.begin() + static_cast<std::ptrdiff_t>(start));
      const ConvexRegion::Part part = within(region, t, -1.0);
      EXPECT_NEAR(part.area, cases[i].area, 1e-9) << i;
      EXPECT_NEAR(part.heightTimesArea, cases[i].area * (cases[i].height + 1.0), 1e-8) << i;
    }
  }
}

TEST(ConvexRegion, ReachesBeyondItsPlanesByTheTolerance)
{
  constexpr double tolerance = 0.01;
  const Box3 box{Vec3(0, 0, 0), Vec3(2, 4, 6)};
  const PlacedPrism upright(Placement(), {{0, 0}, {2, 0}, {2, 4}, {0, 4}}, 0.0, 6.0);
  ASSERT_FALSE(upright.isBox());
  for (const ConvexRegion& region :
       {ConvexRegion(box, tolerance), ConvexRegion(PlacedPrism({Placement(), box}), tolerance),
        ConvexRegion(upright, tolerance)})
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      for (const double factor : {0.9, 1.1})
      {
        // A small triangle in front of the middle of a side.
        const int axis = axisOf(direction);
        Corners t;
        t.fill(box.center());
        t[1][(axis + 1) % 3] += 0.1;
        t[2][(axis + 2) % 3] += 0.1;
        const double beyond = factor * tolerance;
        std::ranges::for_each(
            t, [&](Vec3& p) { p[axis] = isUpper(direction) ? box.max[axis] + beyond : box.min[axis] - beyond; });
        EXPECT_NEAR(within(region, t).area, factor < 1.0 ? 0.005 : 0.0, 1e-12) << direction;
      }
    }
  }
}

TEST(ConvexRegion, OfAPrismThatIsABoxIsTheBox)
{
  const Box3 box{Vec3(-1, -2, -1.5), Vec3(2, 1, 1)};
  const std::vector<ConvexRegion> regions{
      ConvexRegion(PlacedPrism({Placement(), box}), 0.25),
      ConvexRegion(PlacedPrism(Placement(), {{-1, -2}, {2, -2}, {2, 1}, {-1, 1}}, -1.5, 1.0), 0.25)};
  const ConvexRegion expected(box, 0.25);
  RandomTriangles triangles(5);
  for (int round = 0; round < 300; ++round)
  {
    const Corners t = triangles.triangle();
    for (const ConvexRegion& region : regions)
    {
      EXPECT_NEAR(within(region, t, 0.5).area, within(expected, t).area, 1e-11);
      EXPECT_NEAR(within(region, t, 0.5).heightTimesArea, within(expected, t, 0.5).heightTimesArea, 1e-11);
    }
  }
}

TEST(ConvexRegion, OfPartsOfAPrismHaveAllThatThePrismHas)
{
  const std::vector<Vec2> hexagon{{2, 0}, {1, 1.7}, {-1, 1.7}, {-2, 0}, {-1, -1.7}, {1, -1.7}};
  const std::vector<Vec2> upper(hexagon.begin(), hexagon.begin() + 4);
  const std::vector<Vec2> lower{hexagon[3], hexagon[4], hexagon[5], hexagon[0]};
  const ConvexRegion whole(PlacedPrism(Placement(), hexagon, -2.0, 2.0), 0.0);
  const std::vector<ConvexRegion> parts{ConvexRegion(PlacedPrism(Placement(), upper, -2.0, 1.0), 0.0),
                                        ConvexRegion(PlacedPrism(Placement(), lower, -2.0, 1.0), 0.0),
                                        ConvexRegion(PlacedPrism(Placement(), hexagon, 1.0, 2.0), 0.0)};
  RandomTriangles triangles(7);
  for (int round = 0; round < 200; ++round)
  {
    const Corners t = triangles.triangle();
    EXPECT_NEAR(sumOver(parts, t, 0.0).area, within(whole, t).area, 1e-11);
  }
  const Corners level{Vec3(-99, -99, 0), Vec3(99, -99, 0), Vec3(0, 99, 0)};
  EXPECT_NEAR(within(whole, level).area, 2 * 1.7 * 3, 1e-9);
}

// Drawn surfaces.

TEST(DrawnSurfaces, AreMeasuredWithinTheDomainAndOutside)
{
  TriangleSurface surface;
  addSheet(surface, "Inside", Vec3(1, 1, 1), Vec3(2, 0, 0), Vec3(0, 3, 0));
  addSheet(surface, "Half", Vec3(-2, 0, 0), Vec3(4, 0, 0), Vec3(0, 5, 0));
  addSheet(surface, "Buried", Vec3(5, 1, -3), Vec3(0, 2, 0), Vec3(0, 0, 4));
  addSheet(surface, "Far", Vec3(50, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0));
  surface.names.emplace_back("Nothing");
  addSheet(surface, "Twice", Vec3(1, 1, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  addSheet(surface, "Twice", Vec3(1, 1, 2), Vec3(1, 0, 0), Vec3(0, 1, 0));
  surface.names.pop_back();
  std::ranges::replace(surface.surfaceIds, Index{6}, Index{5});
  addSheet(surface, "Side", Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
  surface.names.pop_back(); // its triangles are sides of the domain
  for (const double degrees : {0.0, 30.0, 90.0})
  {
    SCOPED_TRACE(degrees);
    TriangleSurface turned = surface;
    atria::testing::turn(turned, degrees);
    const PlacedPrism domain({Placement(degrees), Box3{Vec3(0, 0, 0), Vec3(10, 10, 10)}});
    const DrawnSurfaces drawn = measureDrawn(turned, domain, 1e-9);
    const auto near = [](double value) { return DoubleNear(value, 1e-6); };
    EXPECT_THAT(drawn.areas, ElementsAre(near(6), near(10), near(2), near(0), near(0), near(2)));
    EXPECT_THAT(drawn.outside, ElementsAre(near(0), near(10), near(6), near(12), near(0), near(0)));
    EXPECT_EQ(drawn.extents.size(), 6U);
    EXPECT_EQ(drawn.extents[4], 0.0) << "it has no triangles";
    EXPECT_NEAR(drawn.extents[2], std::hypot(2.0, 4.0), 1e-9);
  }
}

TEST(DrawnSurfaces, HaveAllOfTheirAreaInAreasAndOutside)
{
  RandomTriangles triangles(11);
  TriangleSurface surface;
  std::vector<double> expected;
  std::vector<Box3> bounds;
  for (int i = 0; i < 30; ++i)
  {
    const Corners t = triangles.triangle();
    addSurface(surface, "S" + std::to_string(i), {t[0], t[1], t[2]}, {{0, 1, 2}});
    expected.push_back(areaOf(t));
    bounds.emplace_back();
    std::ranges::for_each(t, [&](const Vec3& p) { bounds.back().extend(p); });
  }
  const DrawnSurfaces drawn = measureDrawn(surface, {{Placement(20.0), {Vec3(-2, -2, -2), Vec3(2, 2, 3)}}, 5}, 0.0);
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_NEAR(drawn.areas[i] + drawn.outside[i], expected[i], 1e-11);
    EXPECT_GE(drawn.areas[i], 0.0);
    EXPECT_GE(drawn.outside[i], 0.0);
    EXPECT_DOUBLE_EQ(drawn.extents[i], bounds[i].size().norm());
  }
}

} // namespace
