// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the planes of walls.
#include "Surface/Openings/WallPlanes.h"
#include "WallQuads.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using atria::testing::Quads;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

void expectSound(const SurfaceModel& model, const std::vector<WallPlane>& planes, double distance)
{
  std::set<Index> seen;
  for (const WallPlane& plane : planes)
  {
    Box3 bounds;
    double area = 0.0;
    EXPECT_TRUE(std::ranges::is_sorted(plane.triangles));
    for (const Index t : plane.triangles)
    {
      EXPECT_TRUE(seen.insert(t).second) << "each triangle is in one plane";
      area += 0.5 * model.normal(t).norm();
      for (int i = 0; i < 3; ++i)
      {
        bounds.extend(toVector(model.corner(t, i)));
        EXPECT_LE(std::abs(plane.heightOf(toVector(model.corner(t, i)))), distance);
      }
    }
    EXPECT_NEAR(plane.area, area, 1e-9 * area);
    EXPECT_EQ(plane.bounds.min, bounds.min);
    EXPECT_EQ(plane.bounds.max, bounds.max);
    EXPECT_LT((plane.u.cross(plane.v) - plane.normal).norm(), 1e-12);
    EXPECT_NEAR(plane.normal.norm(), 1.0, 1e-12);
    EXPECT_NEAR(plane.u.norm(), 1.0, 1e-12);
  }
}

TEST(WallPlanes, HoldAllChartsInOnePlaneWhicheverWayTheyFace)
{
  Quads quads;
  quads.addLevel(4, 0, 0, 100, 50);
  quads.addLevel(1, 0, 500, 300, 50);
  quads.addLevel(0, 0, 0, 200, 90);                                             // another plane
  quads.add(2, {900, 0, 50}, {900, 50, 50}, {950, 50, 50}, {950, 0, 50});       // faces down
  quads.add(3, {0, -50, 0}, {200, -50, 0}, {200, -50, 200}, {0, -50, 200});     // stands upright
  quads.add(5, {0, -50, 300}, {0, -50, 500}, {100, -50, 500}, {100, -50, 300}); // faces the other way
  const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
  expectSound(quads.model, planes, 10.0);
  ASSERT_EQ(planes.size(), 3u);
  EXPECT_THAT(planes[0].triangles, ElementsAre(0, 1, 2, 3, 6, 7)) << "it has the largest triangle";
  EXPECT_EQ(planes[0].normal, Vec3::UnitZ());
  EXPECT_EQ(planes[0].area, 10000.0 + 90000.0 + 2500.0);
  EXPECT_THAT(planes[1].triangles, ElementsAre(4, 5)) << "the first of equal ones has the lower chart";
  EXPECT_THAT(planes[2].triangles, ElementsAre(8, 9, 10, 11));
  EXPECT_EQ(planes[2].normal, -Vec3::UnitY());
}

TEST(WallPlanes, HoldChartsWithinTheDistance)
{
  for (const std::int64_t offset : {-11, -10, 10, 11})
  {
    Quads quads;
    quads.addLevel(0, 0, 0, 1000, 0);
    quads.addLevel(1, 2000, 0, 100, offset);
    const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
    expectSound(quads.model, planes, 10.0);
    EXPECT_EQ(planes.size(), std::abs(offset) <= 10 ? 1u : 2u) << offset;
  }
}

/// Moves the coordinates of all points up by one axis, `turns` times.
void turnAxes(SurfaceModel& model, int turns)
{
  for (LatticePoint& p : model.points)
  {
    std::rotate(p.begin(), p.begin() + turns, p.end());
  }
}

TEST(WallPlanes, HoldChartsThatAreTurnedALittle)
{
  for (const std::int64_t rise : {0, 4, 9, 10, 11, 40})
  {
    for (int round = 0; round < 12; ++round)
    {
      Quads quads;
      quads.addLevel(0, 0, 0, 6000, 0);
      std::array<LatticePoint, 4> q{{{0, 0, 0}, {4000, 0, rise}, {4000, 100, rise}, {0, 100, 0}}};
      std::ranges::for_each(q, [&](LatticePoint& p) { round % 2 == 0 ? void() : std::swap(p[0], p[1]); });
      round / 2 % 2 == 0 ? quads.add(1, q[3], q[2], q[1], q[0]) : quads.add(1, q[0], q[1], q[2], q[3]);
      turnAxes(quads.model, round / 4);
      const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
      expectSound(quads.model, planes, 10.0);
      EXPECT_EQ(planes.size(), rise <= 10 ? 1u : 2u) << rise << ' ' << round;
    }
  }
}

TEST(WallPlanes, HoldAChartBetweenTwoOfThemInThatOfTheLargerTriangle)
{
  Quads quads;
  quads.addLevel(0, 3000, 0, 100, 8);
  quads.addLevel(1, 2000, 0, 500, 15);
  quads.addLevel(2, 0, 0, 1000, 0);
  const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
  ASSERT_EQ(planes.size(), 2u);
  EXPECT_THAT(planes[0].triangles, ElementsAre(0, 1, 4, 5));
}

TEST(WallPlanes, HoldNoChartsThatAreNotPlane)
{
  for (const std::int64_t height : {0, 10, 11, 500})
  {
    Quads quads;
    quads.add(7, {0, 0, 0}, {2000, 0, 0}, {2000, 2000, 0}, {1000, 1500, height});
    const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
    EXPECT_EQ(planes.size(), height <= 10 ? 1u : 0u) << height;
  }
}

TEST(WallPlanes, HoldNoSidesOfTheDomain)
{
  Quads quads;
  quads.addLevel(0, 0, 0, 100, 0);
  quads.addLevel(1, 200, 0, 100, 0);
  quads.addLevel(2, 400, 0, 100, 0);
  quads.model.domainSides[1] = zMin;
  quads.model.surfaceIds[3] = 2; // beyond the names: a side of a turned domain
  const std::vector<WallPlane> planes = findWallPlanes(quads.model, 1.0);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_THAT(planes[0].triangles, ElementsAre(0, 2, 4, 5));
  EXPECT_THAT(findWallPlanes(SurfaceModel{}, 1.0), IsEmpty());
}

TEST(WallPlanes, LieInTheLargestTriangle)
{
  Quads quads;
  quads.addTriangle(0, {0, 0, 5}, {100, 0, 0}, {0, 100, 0});
  quads.addTriangle(0, {100, 0, 0}, {2000, 2000, 0}, {0, 100, 0});
  const std::vector<WallPlane> planes = findWallPlanes(quads.model, 10.0);
  ASSERT_EQ(planes.size(), 1u);
  EXPECT_EQ(planes[0].normal, Vec3::UnitZ());
  EXPECT_EQ(planes[0].origin[2], 0.0);
}

TEST(WallPlanes, HavePlacesOfTheirOwn)
{
  Quads quads;
  quads.add(0, {10, 20, 30}, {110, 20, 80}, {110, 140, 110}, {10, 140, 60});
  const WallPlane plane = findWallPlanes(quads.model, 10.0).at(0);
  for (const Vec3& p : {Vec3(10, 20, 30), Vec3(110, 140, 110), Vec3(60, 80, 70)})
  {
    EXPECT_NEAR(plane.heightOf(p), 0.0, 1e-9);
    EXPECT_LT((plane.pointAt(plane.placeOf(p)) - p).norm(), 1e-9);
    EXPECT_NEAR(plane.heightOf(p + 3.0 * plane.normal), 3.0, 1e-9);
    EXPECT_LT((plane.placeOf(p + 3.0 * plane.normal) - plane.placeOf(p)).norm(), 1e-9);
  }
  const auto& t = quads.model.triangles[0];
  const auto place = [&](Index p) { return plane.placeOf(toVector(quads.model.points[p])); };
  const Vec2 along = place(t[1]) - place(t[0]);
  const Vec2 on = place(t[2]) - place(t[0]);
  EXPECT_NEAR(along[0] * on[1] - along[1] * on[0], quads.model.normal(0).norm(), 1e-6) << "counterclockwise";
}

} // namespace
