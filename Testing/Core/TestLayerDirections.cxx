// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests the walls of layers on blocks of cubes, and the directions in which layers grow.
#include "Dual/Mesh/Sheets.h"
#include "Layer/LayerDirections.h"
#include "Layer/LayerWalls.h"
#include "LayerBlock.h"
#include "Support/QuietContext.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;

/// Random unit vectors, all on one side of a random plane.
std::vector<Vec3> randomNormals(std::mt19937& random, std::size_t count)
{
  std::normal_distribution<double> some;
  const Vec3 axis = Vec3(some(random), some(random), some(random)).normalized();
  std::vector<Vec3> normals;
  while (normals.size() < count)
  {
    const Vec3 v = Vec3(some(random), some(random), some(random)).normalized();
    if (v.dot(axis) > 0.2)
    {
      normals.push_back(v);
    }
  }
  return normals;
}

double leastCosine(const Vec3& direction, const std::vector<Vec3>& normals)
{
  double least = 1.0;
  for (const Vec3& normal : normals)
  {
    least = std::min(least, normal.dot(direction));
  }
  return least;
}

TEST(LayerDirection, IsTheBestOfAllDirections)
{
  std::mt19937 random(1);
  std::normal_distribution<double> some;
  for (int round = 0; round < 200; ++round)
  {
    const std::vector<Vec3> walls = randomNormals(random, 1 + static_cast<std::size_t>(round) % 7);
    const LayerDirection found = solveDirection({walls, {}, {}, {}});
    EXPECT_NEAR(found.direction.norm(), 1.0, 1e-12);
    EXPECT_NEAR(found.cosine, leastCosine(found.direction, walls), 1e-12);
    EXPECT_GT(found.cosine, 0.2 - 1e-9) << "the axis is as good";
    for (int i = 0; i < 60; ++i)
    {
      const double step = std::pow(10.0, -(i % 5));
      const Vec3 way(some(random), some(random), some(random));
      EXPECT_LE(leastCosine((found.direction + step * way).normalized(), walls), found.cosine + 1e-9);
    }
  }
}

TEST(LayerDirection, IsTheBestInThePlaneOfASide)
{
  std::mt19937 random(2);
  std::normal_distribution<double> some;
  std::uniform_real_distribution<double> angle(-1.3, 1.3);
  for (int round = 0; round < 100; ++round)
  {
    const Vec3 side = Vec3(some(random), some(random), some(random)).normalized();
    const Vec3 middle = side.unitOrthogonal();
    std::vector<Vec3> walls(1 + static_cast<std::size_t>(round) % 5); // square to the side
    std::ranges::generate(walls, [&] { return Vec3(Eigen::AngleAxisd(angle(random), side) * middle); });
    const LayerDirection found = solveDirection({walls, {}, {}, {side, -side}});
    EXPECT_NEAR(found.direction.norm(), 1.0, 1e-12);
    EXPECT_NEAR(found.direction.dot(side), 0.0, 1e-12);
    const Vec3 across = side.cross(found.direction);
    for (const double step : {-0.5, -1e-2, -1e-4, 1e-4, 1e-2, 0.5})
    {
      EXPECT_LE(leastCosine((found.direction + step * across).normalized(), walls), found.cosine + 1e-9);
    }
  }
}

TEST(LayerDirection, StaysInTheOnePlaneOfSheetsThatDifferLittle)
{
  const auto tilted = [](double degrees) {
    const double angle = degrees * EIGEN_PI / 180.0;
    return Vec3(0, std::sin(angle), std::cos(angle));
  };
  // Two normals spread by sin^2 of half the angle between them, up to 0.1 in one plane.
  EXPECT_NEAR(solveDirection({{}, {tilted(17), tilted(-17)}, {Vec3(1, 1, 1).normalized()}, {}}).direction[2], 0.0,
              1e-9);
  const Vec3 along = solveDirection({{}, {tilted(20), tilted(-20)}, {Vec3(1, 1, 1).normalized()}, {}}).direction;
  EXPECT_NEAR((along - Vec3::UnitX()).norm(), 0.0, 1e-9) << "they are two planes";
  EXPECT_EQ(solveDirection({{}, {}, {}, {}}).cosine, -1.0);
  EXPECT_EQ(solveDirection({{Vec3::UnitZ()}, {}, {}, {Vec3::UnitZ()}}).direction, Vec3(Vec3::Zero()));
}

TEST(LayerWalls, CountTheMostLayersAroundPoints)
{
  const Grown of({3, 3, 3}, {{"zMin", {4}}, {"xMin", {2}}, {"xMax", {7}}});
  for (Index i = 0; i < 4; ++i)
  {
    for (Index k = 0; k < 4; ++k)
    {
      const Index expected = i == 3 ? 7 : k == 0 ? 4 : i == 0 ? 2 : 0;
      EXPECT_EQ(of.walls.counts[of.block.pointAt(i, 1, k)], expected) << i << " " << k;
    }
  }
}

TEST(LayerDirections, LeadOffWallsAndAlongSides)
{
  const Grown of({3, 3, 3}, {{"zMin", {1}}, {"xMin", {1}}});
  const double half = std::sqrt(0.5);
  EXPECT_NEAR((of.wayAt(1, 1, 0) - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(0, 1, 2) - Vec3::UnitX()).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(0, 2, 0) - Vec3(half, 0, half)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(0, 0, 0) - Vec3(half, 0, half)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(3, 3, 0) - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(of.directionAt(of.block.pointAt(0, 1, 0)).cosine, half, 1e-12);
  EXPECT_NEAR(of.directionAt(of.block.pointAt(1, 1, 0)).cosine, 1.0, 1e-12);
}

TEST(LayerDirections, OfASlopeStayInTheSidesAtItsEnds)
{
  Grown of({3, 3, 3}, {{"zMin", {1}}});
  for (Vec3& p : of.block.mesh.points)
  {
    p[2] = 0.4 * p[0] + p[2];
  }
  const double length = std::hypot(0.4, 1.0);
  EXPECT_NEAR((of.wayAt(1, 2, 0) - Vec3(-0.4, 0, 1) / length).norm(), 0.0, 1e-12);
  EXPECT_NEAR((of.wayAt(1, 0, 0) - Vec3(-0.4, 0, 1) / length).norm(), 0.0, 1e-12);
  for (const Index i : {0U, 3U})
  {
    EXPECT_EQ(of.wayAt(i, 1, 0), Vec3::UnitZ());
    EXPECT_NEAR(of.directionAt(of.block.pointAt(i, 1, 0)).cosine, 1.0 / length, 1e-12);
  }
  LayerDirections directions(of.walls, of.options);
  directions.update(of.block.mesh, of.walls.counts, quietContext());
  for (Index f = 0; f < of.walls.roles.size(); ++f)
  {
    const bool isWall = of.block.mesh.boundaryFaces[f].direction == zMin;
    EXPECT_TRUE(!isWall || (directions.normal(f) - Vec3(-0.4, 0, 1)).norm() < 1e-12);
  }
}

TEST(LayerDirections, AreNoneWhereASideIsOffItsPlane)
{
  Grown of({3, 3, 3}, {{"zMin", {1}}});
  of.place(0, 1, 1)[0] += 0.01;
  for (Index j = 0; j < 4; ++j)
  {
    EXPECT_EQ(of.wayAt(0, j, 0).isZero(), j < 3) << j;
    EXPECT_FALSE(of.wayAt(1, j, 0).isZero());
  }
  of.place(0, 1, 1)[0] = 1e-7;
  EXPECT_FALSE(of.wayAt(0, 1, 0).isZero()) << "rounding is allowed";
}

TEST(LayerDirections, LeanAwayFromAFaceThatIsStraightThere)
{
  Grown of({4, 4, 2}, {{"zMin", {1}}});
  of.place(2, 2, 0) = Vec3(2.49, 2.49, 0); // almost on the line from (3, 2) to (2, 3)
  const double part = 0.25 * std::sqrt(0.5);
  EXPECT_NEAR((of.wayAt(2, 2, 0) - Vec3(-part, -part, 1).normalized()).norm(), 0.0, 1e-9);
  EXPECT_EQ(of.wayAt(3, 2, 0), Vec3::UnitZ());
  of.place(2, 2, 0) = Vec3(2.4, 2.4, 0); // 11 degrees from it at either side
  EXPECT_EQ(of.wayAt(2, 2, 0), Vec3::UnitZ());
}

TEST(LayerDirections, TaperToTheBoundaryEdgeOfASheetInItsPlane)
{
  // A sheet over the half of the cubes with y < 2, which ends on three sides of the domain.
  Grown of({4, 4, 2}, {{"Wall", {1}}});
  of.block = blockInDomain({4, 4, 2}, {0, 1, 2, 3, 4, 5, 6, 7});
  const std::vector<Index> sources = splitSheets(of.block.mesh, quietContext());
  ASSERT_EQ(sources.size(), 10U) << "all points but those of the boundary edge";
  of.findWalls();
  for (Index i = 0; i < 5; ++i)
  {
    EXPECT_NEAR((of.wayAt(i, 2, 1) - Vec3::UnitY()).norm(), 0.0, 1e-12) << i;
    EXPECT_NEAR(of.directionAt(of.block.pointAt(i, 2, 1)).cosine, 0.0, 1e-12);
    EXPECT_NEAR((of.wayAt(i, 1, 1) + Vec3::UnitZ()).norm(), 0.0, 1e-12) << "the elements below keep the points";
  }
  for (Index copy = 0; copy < sources.size(); ++copy)
  {
    const Index point = static_cast<Index>(of.block.mesh.points.size() - sources.size()) + copy;
    EXPECT_NEAR((of.directionAt(point).direction - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  }
}

TEST(LayerDirections, AreTheSameFoundAgainAroundWhatMovedAndFoundAnew)
{
  Grown of({4, 4, 3}, {{"zMin", {1}}, {"xMin", {1}}});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> some(-0.2, 0.2);
  LayerDirections again(of.walls, of.options);
  std::vector<Index> counts = of.walls.counts;
  std::ranges::fill(counts, 0); // points get theirs one after the other
  for (int round = 0; round < 30; ++round)
  {
    const auto at = static_cast<Index>(random() % of.block.mesh.points.size());
    of.block.mesh.points[at] += Vec3(some(random), some(random), some(random));
    for (std::size_t p = 0; p < counts.size(); ++p)
    {
      counts[p] = static_cast<int>(p % 20) <= round ? of.walls.counts[p] : 0;
    }
    again.update(of.block.mesh, counts, quietContext());
    LayerDirections anew(of.walls, of.options);
    anew.update(of.block.mesh, counts, quietContext());
    for (Index p = 0; p < counts.size(); ++p)
    {
      EXPECT_TRUE(counts[p] == 0 || again.at(p).direction == anew.at(p).direction) << round;
      EXPECT_TRUE(counts[p] == 0 || again.at(p).cosine == anew.at(p).cosine);
    }
    for (Index f = 0; f < of.walls.roles.size(); ++f)
    {
      EXPECT_EQ(again.normal(f), anew.normal(f));
    }
  }
}

} // namespace
