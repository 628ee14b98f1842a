// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests how a terrain is made and extended.
#include "Domain/PlumbLines.h"
#include "Domain/Terrain.h"
#include "Support/Error.h"
#include "Support/Shapes.h"
#include "TerrainSamples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr double rounding = 1e-9;

TEST(Terrain, IsTheSiteIfItIsHigherThanFlat)
{
  TriangleSurface surface;
  addSheet(surface, "House", Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 9));
  addSheet(surface, "Site", Vec3(0, 0, 3), Vec3(8, 0, 0.5), Vec3(0, 8, 0));
  EXPECT_THAT(terrainSurfaces(surface, "", "Site", 0.49), ElementsAre(0, 1));
  EXPECT_THAT(terrainSurfaces(surface, "", "Site", 0.5), ElementsAre(0, 0)) << "not more than it";
  EXPECT_THAT(terrainSurfaces(surface, "", "site", 0.0), ElementsAre(0, 0));
  EXPECT_THAT(terrainSurfaces(surface, "S*", "House", 99.0), ElementsAre(0, 1)) << "a pattern goes first";
  EXPECT_THROW(terrainSurfaces(surface, "T*", "Site", 0.0), Error);
}

/// A terrain of 4 x 3 cells of 1 m from the origin on.
struct HillyGrid
{
  static constexpr int columns = 4;
  static constexpr int rows = 3;
  std::array<std::array<double, rows + 1>, columns + 1> heights{};

  explicit HillyGrid(Random& random)
  {
    for (auto& column : heights)
    {
      std::ranges::generate(column, [&] { return random.in(0, 5); });
    }
  }

  double at(int i, int j) const { return heights.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j)); }

  TriangleSurface surface() const
  {
    std::vector<std::array<Vec3, 4>> quads;
    for (int i = 0; i < columns * rows; ++i)
    {
      const int x = i % columns;
      const int y = i / columns;
      quads.push_back({Vec3(x, y, at(x, y)), Vec3(x + 1, y, at(x + 1, y)), Vec3(x + 1, y + 1, at(x + 1, y + 1)),
                       Vec3(x, y + 1, at(x, y + 1))});
    }
    TriangleSurface out;
    addQuads(out, "Terrain", quads);
    return out;
  }

  /// Height of the border at the place nearest to one outside.
  double besides(double x, double y) const
  {
    const double u = std::clamp(x, 0.0, double{columns});
    const double v = std::clamp(y, 0.0, double{rows});
    const int i = std::min(static_cast<int>(u), columns - 1);
    const int j = std::min(static_cast<int>(v), rows - 1);
    const double s = u - i;
    const double t = v - j;
    return (1 - s) * ((1 - t) * at(i, j) + t * at(i, j + 1)) + s * ((1 - t) * at(i + 1, j) + t * at(i + 1, j + 1));
  }
};

TEST(Terrain, HasTheHeightOfTheNearestPlaceOfAnOutlineAlongTheSides)
{
  Random random(3);
  for (int round = 0; round < 10; ++round)
  {
    const HillyGrid grid(random);
    TriangleSurface surface = grid.surface();
    const TerrainOutline outline = extendTerrain(surface, {1}, {Vec3(-2, -1, 0), Vec3(7, 5, 0)}, 1e-6);
    EXPECT_EQ(outline.borderEdges, 14U);
    EXPECT_EQ(outline.nonManifoldEdges, 0U);
    EXPECT_EQ(outline.openBorders, 0U);
    EXPECT_NEAR(areaFromAbove(surface), 9.0 * 6.0, rounding);
    const PlumbLines lines(surface, allTriangles(surface));
    std::vector<PlumbHit> hits;
    for (int i = 0; i < 60; ++i)
    {
      const Vec2 p(random.in(-2, 7), random.in(-1, 5));
      lines.find(p[0], p[1], hits);
      ASSERT_FALSE(hits.empty()) << p.transpose();
      const bool isInside = p[0] > 0.0 && p[0] < 4.0 && p[1] > 0.0 && p[1] < 3.0;
      EXPECT_TRUE(isInside || std::abs(hits[0].height - grid.besides(p[0], p[1])) < 1e-6) << p.transpose();
    }
  }
}

TEST(Terrain, IsExtendedByTheSurfaceThatIsNearest)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(-2, 0, 0), Vec3(-1, 1, 5)});
  addSheet(surface, "West", Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, 2, 0));
  addSheet(surface, "East", Vec3(1, 0, 1), Vec3(1, 0, 0), Vec3(0, 2, 0));
  const std::size_t before = surface.triangles.size();
  const TerrainOutline outline = extendTerrain(surface, {0, 1, 1}, {Vec3(-3, -1, -9), Vec3(5, 3, 9)}, 1e-6);
  EXPECT_EQ(outline.borderEdges, 6U) << "the common edge is none, nor are those of the house";
  EXPECT_EQ(outline.nonManifoldEdges, 0U);
  ASSERT_EQ(surface.surfaceIds.size(), surface.triangles.size());
  ASSERT_GT(surface.triangles.size(), before);
  for (std::size_t t = before; t < surface.triangles.size(); ++t)
  {
    const double x = middleOf(surface, t)[0];
    EXPECT_TRUE(surface.surfaceIds[t] == (x < 1.0 ? 1U : 2U) || (x > 0.0 && x < 2.0)) << x;
  }
}

TEST(Terrain, KeepsTheWayItFaces)
{
  for (const double way : {1.0, -1.0})
  {
    TriangleSurface surface;
    addSheet(surface, "Terrain", Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0, way, 0));
    extendTerrain(surface, {1}, {Vec3(-2, -2, 0), Vec3(3, 3, 0)}, 1e-6);
    EXPECT_NEAR(areaFromAbove(surface), way * 25.0, rounding);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      EXPECT_GT(way * areaVector(surface, t)[2], 0.0);
    }
  }
}

TEST(Terrain, IsLeftAsItIsWhereItReachesAsFarAsAsked)
{
  TriangleSurface surface;
  addSheet(surface, "Terrain", Vec3(0, 0, 1), Vec3(6, 0, 0), Vec3(0, 4, 0));
  extendTerrain(surface, {1}, {Vec3(1, 1, 0), Vec3(5, 3, 0)}, 1e-6);
  EXPECT_NEAR(areaFromAbove(surface), 24.0, rounding);
  TriangleSurface oneSided;
  addSheet(oneSided, "Terrain", Vec3(0, 0, 1), Vec3(6, 0, 0), Vec3(0, 4, 0));
  extendTerrain(oneSided, {1}, {Vec3(1, 1, 0), Vec3(9, 3, 0)}, 1e-6);
  EXPECT_NEAR(areaFromAbove(oneSided), 36.0, rounding);
}

TEST(Terrain, MergesPointsWithinTheTolerance)
{
  for (const auto& [tolerance, edges] : {std::pair(1e-6, std::size_t{6}), {0.01, std::size_t{4}}})
  {
    TriangleSurface surface;
    addSurface(surface, "Terrain",
               {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-0.001, 0.001, 0}, {0.999, 1.001, 0}, {-0.001, 1.001, 0}},
               {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(extendTerrain(surface, {1}, {Vec3(-1, -1, 0), Vec3(2, 2, 0)}, tolerance).borderEdges, edges);
  }
}

TEST(Terrain, MergesPointsWhereverTheyAre)
{
  for (int i = 0; i < 100; ++i)
  {
    TriangleSurface surface;
    const double x = 0.0001 * i;
    const double off = x + 0.0002;
    addSurface(surface, "Terrain", {{x, 0, 0}, {1, 0, 0}, {x, 1, 0}, {off, 0, 0}, {off, 1, 0}, {-1, 0, 0}},
               {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(extendTerrain(surface, {1}, {Vec3(-2, -2, 0), Vec3(2, 2, 0)}, 0.01).borderEdges, 4U) << x;
  }
}

TEST(Terrain, CountsEdgesOfThreeTriangles)
{
  TriangleSurface surface;
  addSurface(surface, "Terrain", {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1.5, 0.5, 3}},
             {{0, 1, 2}, {0, 2, 3}, {0, 4, 2}});
  const TerrainOutline outline = extendTerrain(surface, {1}, {Vec3(-1, -1, 0), Vec3(3, 3, 0)}, 1e-6);
  EXPECT_EQ(outline.nonManifoldEdges, 1U);
  EXPECT_EQ(outline.borderEdges, 6U);
}

TEST(Terrain, ThatIsClosedOrUprightIsRefusedInWords)
{
  const auto wordsOf = [](TriangleSurface surface) -> std::string {
    try
    {
      extendTerrain(surface, {1}, {Vec3(-9, -9, 0), Vec3(9, 9, 0)}, 1e-6);
    }
    catch (const Error& error)
    {
      return error.what();
    }
    return {};
  };
  TriangleSurface solid;
  addBox(solid, "Terrain", {Vec3(0, 0, 0), Vec3(1, 1, 1)});
  EXPECT_THAT(wordsOf(solid), HasSubstr("closed"));
  for (const Vec3& along : {Vec3(1, 0, 0), Vec3(0, 1, 0)})
  {
    TriangleSurface wall;
    addSheet(wall, "Terrain", Vec3(0, 0, 0), along, Vec3(0, 0, 1));
    EXPECT_THAT(wordsOf(wall), HasSubstr("no extent"));
  }
}

} // namespace
