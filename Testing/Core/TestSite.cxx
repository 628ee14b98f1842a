// SPDX-License-Identifier: GPL-3.0-or-later
/// Domain, alignment and terrain.
#include "Domain/Alignment.h"
#include "Domain/Domain.h"
#include "Domain/PlacedModel.h"
#include "Support/Error.h"
#include "Support/NamePattern.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"
#include "Surface/Model/SurfaceModel.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include <cmath>

namespace {

using atria::Box3;
using atria::DomainMode;
using atria::GridAlignment;
using atria::GridOptions;
using atria::Index;
using atria::PlacedModel;
using atria::Placement;
using atria::SiteOptions;
using atria::SitePlan;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::addSurface;
using atria::testing::turn;

constexpr double rounding = 1e-9;

const Box3 tower{Vec3(10, 20, 0), Vec3(22, 28, 30)};

TriangleSurface towerAndHut()
{
  TriangleSurface surface;
  addBox(surface, "Tower", tower);
  addBox(surface, "Hut", {Vec3(-10, 20, 0), Vec3(0, 30, 5)});
  return surface;
}

GridOptions sizes(double sizeMin, double sizeMax)
{
  GridOptions options;
  options.sizeMin = sizeMin;
  options.sizeMid = sizeMin;
  options.sizeMax = sizeMax;
  return options;
}

/// Area of a surface's triangles as seen from above.
double areaFromAbove(const TriangleSurface& surface)
{
  double area = 0.0;
  for (const auto& [a, b, c] : surface.triangles)
  {
    const Vec3 u = surface.points[b] - surface.points[a];
    const Vec3 v = surface.points[c] - surface.points[a];
    area += 0.5 * (u[0] * v[1] - u[1] * v[0]);
  }
  return area;
}

/// A valley: two planes that meet at y = 5, along x, in the square from 0 to 10.
TriangleSurface valley()
{
  TriangleSurface surface;
  addSurface(surface, "Site", {{0, 0, 3}, {10, 0, 3}, {10, 5, 1}, {0, 5, 1}, {10, 10, 2}, {0, 10, 2}},
             {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}});
  return surface;
}

TEST(Placement, QuarterTurnsAreExact)
{
  const Vec3 p(1.25, -7.5, 3.0);
  EXPECT_EQ(Placement(0).fromModel(p), p);
  EXPECT_EQ(Placement(90).fromModel(p), Vec3(-7.5, -1.25, 3.0));
  EXPECT_EQ(Placement(180).fromModel(p), Vec3(-1.25, 7.5, 3.0));
  EXPECT_EQ(Placement(-90).fromModel(p), Vec3(7.5, 1.25, 3.0));
  EXPECT_EQ(Placement(270).toModel(Placement(270).fromModel(p)), p);
}

TEST(Placement, TurnsAndTurnsBack)
{
  const Placement axes(30);
  const Vec3 along = axes.fromModel(Vec3(std::sqrt(3.0), 1.0, 5.0));
  EXPECT_NEAR((along - Vec3(2, 0, 5)).norm(), 0.0, 1e-15);
  const Vec3 p(123.4, -56.7, 8.9);
  EXPECT_NEAR((axes.toModel(axes.fromModel(p)) - p).norm(), 0.0, 1e-13);
}

TEST(Alignment, IsTheDirectionOfTheWallsWhateverElseThereIs)
{
  for (const double angle : {0.0, 17.0, 44.0, -44.0, 89.0, 123.456})
  {
    SCOPED_TRACE(angle);
    TriangleSurface surface = towerAndHut();
    turn(surface, angle);
    TriangleSurface askew;
    addBox(askew, "Askew", {Vec3(50, 0, 0), Vec3(60, 10, 9)});
    turn(askew, angle + 0.3);
    addSurface(surface, "Askew", askew.points, askew.triangles);
    atria::testing::addSphere(surface, "Tree", Vec3(100, 0, 20), 9.0, 3);
    addSheet(surface, "Ground", Vec3(-900, -900, 0), Vec3(1900, 300, 0), Vec3(-300, 1900, 0));
    EXPECT_NEAR(std::remainder(atria::dominantWallAngle(surface) - angle, 90.0), 0.0, 1e-9);
  }
}

TEST(Alignment, IsTheAxesWithoutWalls)
{
  TriangleSurface surface;
  addSheet(surface, "Ground", Vec3(0, 0, 0), Vec3(10, 3, 0), Vec3(-3, 10, 0));
  EXPECT_EQ(atria::dominantWallAngle(surface), 0.0);
}

TEST(AutomaticDomain, HasTheRulesDistances)
{
  for (const double angle : {0.0, 90.0, 180.0})
  {
    SCOPED_TRACE(angle);
    SiteOptions options;
    options.mode = DomainMode::automatic;
    options.windAngle = angle;
    const SitePlan plan = atria::planSite(towerAndHut(), options, sizes(1, 8));
    const Box3 buildings = atria::boundsOf(towerAndHut(), Placement(angle));
    EXPECT_EQ(plan.widened, 1.0);
    EXPECT_NEAR((plan.domain.bounds.min - (buildings.min - Vec3(150, 150, 0))).norm(), 0.0, rounding);
    EXPECT_NEAR((plan.domain.bounds.max - (buildings.max + Vec3(450, 150, 150))).norm(), 0.0, rounding);
  }
}

TEST(AutomaticDomain, TakesTheHeightAboveTheGround)
{
  TriangleSurface surface;
  // A slope that rises by 0.1; the foot of the wall is at 10, its top at 18.
  addSheet(surface, "Site", Vec3(0, 0, 0), Vec3(200, 0, 20), Vec3(0, 200, 0));
  addSheet(surface, "Wall", Vec3(100, 90, 10), Vec3(0, 20, 0), Vec3(0, 0, 8));
  SiteOptions options;
  options.mode = DomainMode::automatic;
  const GridOptions grid = sizes(1, 8);
  const SitePlan plan = atria::planSite(surface, options, grid);
  EXPECT_NEAR(plan.domain.bounds.max[2], 18.0 + 5 * 8.0, rounding);
  EXPECT_NEAR(plan.domain.bounds.min[0], 100.0 - 5 * 8.0, rounding);
  // Two of the largest octants below the terrain.
  EXPECT_NEAR(plan.domain.bounds.min[2], -16.0, rounding);
}

TEST(AutomaticDomain, CountsWhatStandsBehindOneAnotherOnce)
{
  TriangleSurface surface = towerAndHut();
  const atria::SurfaceFlags none(surface.names.size(), 0);
  // Along x the tower (8 x 30, y 20 to 28) hides the hut (10 x 5) but for 2 m.
  EXPECT_NEAR(atria::frontalArea(surface, none, Placement(0), 0.0), 8 * 30 + 2 * 5, rounding);
  EXPECT_NEAR(atria::frontalArea(surface, none, Placement(90), 0.0), 12 * 30 + 10 * 5, rounding);
  EXPECT_NEAR(atria::frontalArea(surface, none, Placement(0), 3.0), 8 * 27 + 2 * 2, rounding);
  addSheet(surface, "Gable", Vec3(0, 40, 0), Vec3(0, 10, 0), Vec3(0, 5, 8)); // a parallelogram
  EXPECT_NEAR(atria::frontalArea(surface, {0, 0, 0}, Placement(0), 0.0), 8 * 30 + 2 * 5 + 80, rounding);
}

TEST(AutomaticDomain, CountsTrianglesThatAreNarrowerThanAStrip)
{
  // A wall of 20 by 6 m in 6000 columns.
  constexpr Index columns = 6000;
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  for (Index i = 0; i <= columns; ++i)
  {
    const double y = 20.0 * i / columns;
    points.insert(points.end(), {Vec3(0, y, 0), Vec3(0, y, 6)});
    if (i > 0)
    {
      triangles.push_back({2 * i - 2, 2 * i, 2 * i - 1});
      triangles.push_back({2 * i - 1, 2 * i, 2 * i + 1});
    }
  }
  TriangleSurface surface;
  atria::testing::addSurface(surface, "Wall", points, triangles);
  EXPECT_NEAR(atria::frontalArea(surface, {0}, Placement(0), 0.0), 120.0, rounding);
}

TEST(AutomaticDomain, IsWidenedUntilTheBlockageIsSmallEnough)
{
  TriangleSurface surface;
  addBox(surface, "Slab", {Vec3(0, 0, 0), Vec3(10, 400, 20)});
  SiteOptions options;
  options.mode = DomainMode::automatic;
  const SitePlan plan = atria::planSite(surface, options, sizes(2, 16));
  EXPECT_GT(plan.widened, 1.0);
  const Vec3 size = plan.domain.bounds.size();
  EXPECT_NEAR(400.0 * 20.0 / (size[1] * size[2]), 0.03, 1e-12);
  EXPECT_NEAR(size[1] - 400.0, 2.0 * (size[2] - 20.0), 1e-9);
  EXPECT_NEAR(size[0], 10.0 + 20.0 * 20.0, rounding);
}

TEST(AutomaticDomain, NeedsBuildings)
{
  SiteOptions options;
  options.mode = DomainMode::automatic;
  EXPECT_THROW(atria::planSite(valley(), options, sizes(1, 8)), atria::Error);
  EXPECT_THROW(atria::planSite({}, options, sizes(1, 8)), atria::Error);
}

TEST(GridAxes, AreTheNearestToTheDomains)
{
  TriangleSurface surface = towerAndHut();
  turn(surface, 30.0);
  SiteOptions options;
  options.mode = DomainMode::automatic;
  options.windAngle = 130.0;
  EXPECT_EQ(atria::planSite(surface, options, sizes(1, 8)).grid.angle(), 90.0);
  options.alignment = GridAlignment::domain;
  EXPECT_EQ(atria::planSite(surface, options, sizes(1, 8)).grid.angle(), 130.0);
  options.alignment = GridAlignment::walls;
  EXPECT_NEAR(atria::planSite(surface, options, sizes(1, 8)).grid.angle(), 120.0, 1e-9);
  options.windAngle = 120.0 + 1e-7;
  EXPECT_EQ(atria::planSite(surface, options, sizes(1, 8)).grid.angle(), 120.0 + 1e-7);
}

TEST(Terrain, IsFoundByPatternOrIsTheSiteThatIsNotFlat)
{
  TriangleSurface surface = valley();
  addBox(surface, "House", tower);
  addSheet(surface, "terrain_2", Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  using ::testing::ElementsAre;
  EXPECT_THAT(atria::terrainSurfaces(surface, "", "Site", 1e-3), ElementsAre(1, 0, 0));
  EXPECT_THAT(atria::terrainSurfaces(surface, "", "Site", 5.0), ElementsAre(0, 0, 0));
  EXPECT_THAT(atria::terrainSurfaces(surface, "", "Lawn", 1e-3), ElementsAre(0, 0, 0));
  EXPECT_THAT(atria::terrainSurfaces(surface, "terr*n_?", "Site", 1e-3), ElementsAre(0, 0, 1));
  EXPECT_THROW(atria::terrainSurfaces(surface, "dgm*", "Site", 1e-3), atria::Error);
  EXPECT_TRUE(atria::matchesPattern("*", "a.b"));
  EXPECT_TRUE(atria::matchesPattern("a*bc", "abcbc"));
  EXPECT_FALSE(atria::matchesPattern("a*bc", "abcb"));
  EXPECT_FALSE(atria::matchesPattern("a?b", "ab"));
}

TEST(Terrain, IsExtendedLevelToTheRectangle)
{
  TriangleSurface surface = valley();
  const Box3 reach{Vec3(-4, -3, 0), Vec3(16, 12, 0)};
  const atria::TerrainOutline outline = atria::extendTerrain(surface, {1}, reach, 1e-6);
  EXPECT_EQ(outline.borderEdges, 6u);
  EXPECT_EQ(outline.openBorders, 0u);
  EXPECT_NEAR(areaFromAbove(surface), 20.0 * 15.0, rounding);
  EXPECT_EQ(surface.surfaceIds.size(), surface.triangles.size());
  // The height depends on y alone, as in the valley itself.
  const atria::Ground ground(surface, {1}, 0.0);
  for (const double x : {-3.9, -1.0, 5.0, 11.0, 15.9})
  {
    for (const double y : {-2.9, 0.0, 2.5, 5.0, 6.0, 10.0, 11.9})
    {
      const double inside = std::clamp(y, 0.0, 10.0);
      EXPECT_NEAR(ground.heightAt(x, y), inside < 5.0 ? 3.0 - 0.4 * inside : 1.0 + 0.2 * (inside - 5.0), rounding)
          << x << " " << y;
    }
  }
}

TEST(Terrain, OfARaggedOutlineIsExtendedWithoutGapsOrOverlap)
{
  // A star with deep notches, an island beside it, and a hole that stays open.
  TriangleSurface surface;
  std::vector<Vec3> points{{0, 0, 5}};
  std::vector<std::array<Index, 3>> triangles;
  constexpr int count = 24;
  for (int i = 0; i < count; ++i)
  {
    const double angle = 2.0 * M_PI * i / count;
    const double radius = i % 3 == 0 ? 20.0 : (i % 3 == 1 ? 9.0 : 14.0);
    points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), i % 5);
  }
  for (Index i = 1; i <= count; ++i)
  {
    if (i != 5)
    {
      triangles.push_back({0, i, i % count + 1});
    }
  }
  addSurface(surface, "Star", points, triangles);
  addSheet(surface, "Island", Vec3(25, 25, 7), Vec3(3, 1, 0), Vec3(-1, 2, 0));
  const Box3 reach{Vec3(-40, -40, 0), Vec3(40, 40, 0)};
  const atria::TerrainOutline outline = atria::extendTerrain(surface, {1, 1}, reach, 1e-6);
  EXPECT_EQ(outline.openBorders, 0u);
  EXPECT_NEAR(areaFromAbove(surface), 80.0 * 80.0, 1e-6);
  for (const auto& [a, b, c] : surface.triangles)
  {
    const Vec3 normal = (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]);
    EXPECT_GE(normal[2], 0.0);
  }
}

TEST(Terrain, KeepsItsHolesAndCountsThem)
{
  TriangleSurface surface;
  addSurface(surface, "Site", {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}, {3, 3, 1}, {6, 3, 1}, {6, 6, 1}, {3, 6, 1}},
             {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}});
  const atria::TerrainOutline outline = atria::extendTerrain(surface, {1}, {Vec3(-1, -1, 0), Vec3(10, 10, 0)}, 1e-6);
  EXPECT_EQ(outline.openBorders, 4u);
  EXPECT_NEAR(areaFromAbove(surface), 11.0 * 11.0 - 9.0, rounding);
}

TEST(Terrain, ThatIsNoneIsRefused)
{
  TriangleSurface wall;
  addSheet(wall, "Site", Vec3(0, 0, 0), Vec3(9, 0, 0), Vec3(0, 0, 9));
  EXPECT_THROW(atria::extendTerrain(wall, {1}, {}, 1e-6), atria::Error);
  TriangleSurface solid;
  addBox(solid, "Site", tower);
  EXPECT_THROW(atria::extendTerrain(solid, {1}, {}, 1e-6), atria::Error);
}

TEST(TurnedSides, CloseTheDomainAndShareEdgesWithWhatTheyCut)
{
  TriangleSurface surface = valley();
  SiteOptions options;
  options.mode = DomainMode::bounds;
  options.bounds = {Vec3(1, 2, 0), Vec3(9, 8, 6)};
  options.domainAngle = 20.0;
  const GridOptions grid = sizes(0.5, 2);
  const SitePlan plan = atria::planSite(surface, options, grid);
  const PlacedModel placed = atria::placeModel(surface, plan, grid);
  ASSERT_TRUE(placed.frame.turnedDomain);
  EXPECT_EQ(placed.frame.placement.angle(), 0.0);
  double terrain = 0.0;
  std::array<double, 4> sideArea{};
  for (std::size_t t = 0; t < placed.surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = placed.surface.triangles[t];
    const auto& p = placed.surface.points;
    const Vec3 area = 0.5 * (p[b] - p[a]).cross(p[c] - p[a]);
    const Index id = placed.surface.surfaceIds[t];
    if (id == 0)
    {
      terrain += area[2];
      continue;
    }
    ASSERT_LT(id, 5u);
    sideArea[id - 1] += area.norm();
    EXPECT_GT(area.dot((p[a] + p[b] + p[c]) / 3.0 - options.bounds.center()), 0.0) << "outwards";
  }
  EXPECT_NEAR(terrain, 8.0 * 6.0, rounding);
  const double height = placed.frame.domain.size()[2] + 2 * 4.0;
  EXPECT_NEAR(sideArea[0], 6.0 * height, 1e-6);
  EXPECT_NEAR(sideArea[3], 8.0 * height, 1e-6);
  const atria::RunContext context = atria::testing::quietContext();
  const atria::SurfaceModel model = atria::makeSurfaceModel(placed.surface, placed.frame, {}, context);
  // Around the terrain's edge three or more triangles meet; nothing but the sides' ends is open.
  for (const atria::FeatureEdge& edge : model.featureEdges)
  {
    if (model.kindOf(edge) == atria::CurveKind::boundary)
    {
      const Vec3 p = placed.frame.toModel(model.points[edge.a]);
      EXPECT_TRUE(p[2] < placed.frame.domain.min[2] || p[2] > placed.frame.domain.max[2]);
    }
  }
}

TEST(Site, NonsenseIsRefused)
{
  const GridOptions grid = sizes(1, 8);
  SiteOptions options;
  options.mode = DomainMode::site;
  options.site = "Lawn";
  EXPECT_THROW(atria::planSite(valley(), options, grid), atria::Error);
  options.site = "Site";
  options.terrain = "x*";
  EXPECT_THROW(atria::planSite(valley(), options, grid), atria::Error);
  SiteOptions none;
  EXPECT_THROW(atria::planSite({}, none, grid), atria::Error);
  SiteOptions thin;
  thin.mode = DomainMode::bounds;
  thin.bounds = {Vec3(0, 0, 0), Vec3(10, 1, 10)};
  thin.domainAngle = 45.0;
  EXPECT_THROW(atria::placeModel(towerAndHut(), atria::planSite(towerAndHut(), thin, grid), grid), atria::Error);
}

TEST(Site, NamesWhatLiesTooFarAway)
{
  TriangleSurface surface = towerAndHut();
  addBox(surface, "Tree", {Vec3(0, 9e6, 0), Vec3(3, 9e6 + 3, 5)});
  const GridOptions grid = sizes(1, 8);
  try
  {
    atria::placeModel(surface, atria::planSite(surface, {}, grid), grid);
    FAIL();
  }
  catch (const atria::Error& error)
  {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("'Hut' and 'Tree' lie 8.99997e+06 m apart along y"),
                                               ::testing::HasSubstr("ExcludedSurfaces")));
  }
}

} // namespace
