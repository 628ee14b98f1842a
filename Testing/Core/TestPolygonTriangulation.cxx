// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangulation/PolygonTriangulation.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

namespace {

using atria::Index;
using atria::PolygonTriangles;
using atria::triangulatePolygon;
using atria::Vec3;

std::vector<Index> upTo(std::size_t count)
{
  std::vector<Index> ids(count);
  std::iota(ids.begin(), ids.end(), Index{0});
  return ids;
}

PolygonTriangles triangulateAll(const std::vector<Vec3>& points)
{
  return triangulatePolygon(points, upTo(points.size()));
}

/// Newell's vector area.
Vec3 areaOf(const std::vector<Vec3>& points, const std::vector<Index>& polygon)
{
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    sum +=
        (points[polygon[i]] - points[polygon[0]]).cross(points[polygon[(i + 1) % polygon.size()]] - points[polygon[0]]);
  }
  return 0.5 * sum;
}

Vec3 areaOf(const std::vector<Vec3>& points, const std::array<Index, 3>& t)
{
  return areaOf(points, std::vector<Index>(t.begin(), t.end()));
}

/// The sum of the triangles' areas; the property that no triangle is turned or counted twice.
double totalArea(const std::vector<Vec3>& points, const PolygonTriangles& result)
{
  double sum = 0.0;
  for (const auto& t : result.triangles)
  {
    sum += areaOf(points, t).norm();
  }
  return sum;
}

void expectValid(const std::vector<Vec3>& points, const std::vector<Index>& polygon, const PolygonTriangles& result)
{
  const Vec3 area = areaOf(points, polygon);
  const std::set<Index> given(polygon.begin(), polygon.end());
  EXPECT_NEAR(totalArea(points, result), area.norm(), 1e-9 * area.norm());
  for (const auto& t : result.triangles)
  {
    EXPECT_TRUE(given.count(t[0]) && given.count(t[1]) && given.count(t[2]));
    EXPECT_GT(areaOf(points, t).dot(area), -1e-9 * area.squaredNorm());
  }
}

class Shapes
{
public:
  explicit Shapes(unsigned seed) : random(seed) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); }

  /// VertexStar-shaped about the origin, with strongly varying radius.
  std::vector<Vec3> star(int count)
  {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i)
    {
      const double angle = 2.0 * std::numbers::pi * (i + in(0.0, 0.8)) / count;
      const double radius = in(0.1, 1.0);
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    }
    return points;
  }

  /// A comb: all teeth reflex, many collinear points.
  std::vector<Vec3> comb(int teeth)
  {
    std::vector<Vec3> points{{static_cast<double>(teeth), -1.0, 0.0}};
    for (int i = teeth; i > 0; --i)
    {
      points.emplace_back(i, in(0.5, 3.0), 0.0);
      points.emplace_back(i - 0.5, 0.0, 0.0);
    }
    points.emplace_back(0.0, -1.0, 0.0);
    return points;
  }

  void place(std::vector<Vec3>& points)
  {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1)).normalized();
    const double size = std::pow(10.0, in(-3.0, 3.0));
    const Vec3 shift(in(-100, 100) * size, in(-100, 100) * size, in(-100, 100) * size);
    for (Vec3& p : points)
    {
      p = turn * (size * p) + shift;
    }
  }

private:
  std::mt19937 random;
};

TEST(PolygonTriangulation, CutsRandomConcavePolygonsInRandomPlanes)
{
  Shapes shapes(7);
  for (int round = 0; round < 400; ++round)
  {
    const int count = 3 + round % 40;
    std::vector<Vec3> points = round % 3 == 0 ? shapes.comb(1 + count / 2) : shapes.star(count);
    shapes.place(points);
    if (round % 2 == 0)
    {
      std::reverse(points.begin(), points.end());
    }
    const PolygonTriangles result = triangulateAll(points);
    SCOPED_TRACE(round);
    EXPECT_TRUE(result.simple);
    EXPECT_EQ(result.triangles.size(), points.size() - 2);
    expectValid(points, upTo(points.size()), result);
  }
}

TEST(PolygonTriangulation, KeepsTheWindingOfATriangle)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const PolygonTriangles result = triangulatePolygon(points, std::vector<Index>{2, 1, 0});
  ASSERT_EQ(result.triangles.size(), 1u);
  EXPECT_EQ(result.triangles[0], (std::array<Index, 3>{2, 1, 0}));
}

TEST(PolygonTriangulation, CutsAConcaveQuadAtItsReflexCorner)
{
  const std::vector<Vec3> points{{0, 0, 0}, {2, 2, 0}, {0, 0.5, 0}, {-2, 2, 0}};
  const PolygonTriangles result = triangulateAll(points);
  EXPECT_EQ(result.triangles.size(), 2u);
  expectValid(points, upTo(4), result);
}

TEST(PolygonTriangulation, CutsAConvexQuadAlongItsShorterDiagonal)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {3, 1, 0}, {0, 1, 0}};
  for (const auto& t : triangulateAll(points).triangles)
  {
    EXPECT_TRUE(std::count(t.begin(), t.end(), 1u) && std::count(t.begin(), t.end(), 3u));
  }
}

TEST(PolygonTriangulation, LeavesOutAHoleReachedByABridge)
{
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                                 {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}};
  const std::vector<Index> polygon{0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  const PolygonTriangles result = triangulatePolygon(points, polygon);
  EXPECT_TRUE(result.simple);
  EXPECT_EQ(result.triangles.size(), 8u);
  EXPECT_NEAR(totalArea(points, result), 12.0, 1e-12);
  expectValid(points, polygon, result);
}

TEST(PolygonTriangulation, TakesBridgesWhoseEndsAreSeparatePointsAtOnePlace)
{
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                                 {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};
  const PolygonTriangles result = triangulateAll(points);
  EXPECT_TRUE(result.simple);
  EXPECT_NEAR(totalArea(points, result), 12.0, 1e-12);
}

TEST(PolygonTriangulation, TakesAHoleThatTouchesTheOutlineInAnEdge)
{
  // A notch described as a hole: the outline's lower edge and the notch's overlap in part.
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0},
                                 {1, 0, 0}, {1, 1, 0}, {3, 1, 0}, {3, 0, 0}};
  const std::vector<Index> polygon{0, 1, 2, 3, 0, 4, 5, 6, 7, 4};
  const PolygonTriangles result = triangulatePolygon(points, polygon);
  EXPECT_TRUE(result.simple);
  EXPECT_NEAR(totalArea(points, result), 14.0, 1e-12);
}

TEST(PolygonTriangulation, TakesAnOutlineThatTouchesItselfInAPoint)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  const std::vector<Index> polygon{1, 0, 2, 1, 3, 4};
  const PolygonTriangles result = triangulatePolygon(points, polygon);
  EXPECT_NEAR(totalArea(points, result), 2.0, 1e-12);
}

TEST(PolygonTriangulation, DropsPointsRepeatedInARowAndSpikes)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {3, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const PolygonTriangles result = triangulateAll(points);
  EXPECT_TRUE(result.simple);
  EXPECT_NEAR(totalArea(points, result), 1.0, 1e-12);
}

TEST(PolygonTriangulation, GivesNothingForPolygonsWithoutArea)
{
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1e308, 0, 0}, {-1e308, 1e308, 0}};
  for (const std::vector<Index>& polygon : {std::vector<Index>{},
                                            {0},
                                            {0, 1},
                                            {0, 1, 2},
                                            {0, 0, 0},
                                            {0, 1, 0, 1},
                                            {0, 1, 2, 1},
                                            {0, 1, 2, 0, 1, 2},
                                            {1, 3, 4}})
  {
    EXPECT_TRUE(triangulatePolygon(points, polygon).triangles.empty());
  }
}

TEST(PolygonTriangulation, SkipsPolygonsWithPointsThatAreNotFinite)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, nan}, {0, 1, 0}};
  EXPECT_TRUE(triangulateAll(points).triangles.empty());
}

TEST(PolygonTriangulation, TakesSlightlyWarpedPolygons)
{
  Shapes shapes(3);
  for (int round = 0; round < 50; ++round)
  {
    std::vector<Vec3> points = shapes.star(5 + round);
    for (Vec3& p : points)
    {
      p.z() = shapes.in(-1e-3, 1e-3);
    }
    const PolygonTriangles result = triangulateAll(points);
    EXPECT_EQ(result.triangles.size(), points.size() - 2);
    EXPECT_NEAR(totalArea(points, result), areaOf(points, upTo(points.size())).norm(), 0.02);
  }
}

TEST(PolygonTriangulation, MarksAnOutlineThatCrossesItself)
{
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 3, 0}, {1, -1, 0}, {0, 3, 0}};
  const PolygonTriangles result = triangulateAll(points);
  EXPECT_FALSE(result.simple);
  EXPECT_FALSE(result.triangles.empty());
}

TEST(PolygonTriangulation, MarksAQuadWhoseCornersAreInTheWrongOrder)
{
  const PolygonTriangles result = triangulateAll({{0, 0, 0}, {4, 0, 3}, {4, 0, 0}, {0, 0, 3}});
  EXPECT_FALSE(result.simple) << "what it bounds has no area with its sign";
  EXPECT_TRUE(triangulateAll({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}).simple) << "this has none at all";
}

TEST(PolygonTriangulation, SurvivesRandomWalksThroughFewPoints)
{
  std::mt19937 random(11);
  std::vector<Vec3> grid;
  for (int i = 0; i < 16; ++i)
  {
    grid.emplace_back(i % 4, i / 4, 0.01 * (i % 3));
  }
  for (int round = 0; round < 3000; ++round)
  {
    std::vector<Index> polygon(3 + random() % 20);
    for (Index& id : polygon)
    {
      id = static_cast<Index>(random() % grid.size());
    }
    const PolygonTriangles result = triangulatePolygon(grid, polygon);
    for (const auto& t : result.triangles)
    {
      for (const Index id : t)
      {
        EXPECT_NE(std::find(polygon.begin(), polygon.end(), id), polygon.end());
      }
    }
  }
}

} // namespace
