// SPDX-License-Identifier: GPL-3.0-or-later
/// Where the ground of a model is, and which bodies are let down to it.
#include "Domain/GroundedModel.h"
#include "Mesher/ModelStages.h"
#include "Support/Cities.h"

#include <gmock/gmock.h>

namespace {

using namespace atria;
using namespace atria::testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

constexpr double sizeMin = 0.5;

GroundedModel ground(const TriangleSurface& surface, const SiteOptions& options = {})
{
  return groundModel(surface, options, {sizeMin, {}, {}});
}

SiteOptions withRatio(double ratio)
{
  SiteOptions options;
  options.groundSnapRatio = ratio;
  return options;
}

std::vector<std::string> namesOf(const std::vector<BodyAtGround>& bodies)
{
  std::vector<std::string> names;
  for (const BodyAtGround& body : bodies)
  {
    names.push_back(body.name);
  }
  return names;
}

Box3 boxOf(const TriangleSurface& surface, const std::string& name)
{
  Box3 box;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (const Index p : surface.triangles[t])
    {
      if (surface.names[surface.surfaceIds[t]] == name)
      {
        box.extend(surface.points[p]);
      }
    }
  }
  return box;
}

bool isAsDrawn(const TriangleSurface& surface, const GroundedModel& grounded)
{
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    for (int i = 0; i < 3; ++i)
    {
      if (surface.points[surface.triangles[t][i]] != grounded.surface.points[grounded.surface.triangles[t][i]])
      {
        return false;
      }
    }
  }
  return surface.triangles.size() == grounded.surface.triangles.size();
}

TriangleSurface threeHouses(bool hasBottom = true)
{
  TriangleSurface surface;
  addHouse(surface, "A", 0, 0, 1.0, 9.0, hasBottom);
  addHouse(surface, "B", 20, 0, 1.4, 9.4, hasBottom);
  addHouse(surface, "C", 40, 0, 2.8, 10.8, hasBottom);
  return surface;
}

class Turned : public ::testing::TestWithParam<double>
{
};

TEST_P(Turned, HousesOnDifferentBasesAreLetDown)
{
  for (const bool hasBottom : {true, false})
  {
    SCOPED_TRACE(hasBottom);
    TriangleSurface surface = threeHouses(hasBottom);
    turn(surface, GetParam());
    const GroundedModel found = ground(surface);
    EXPECT_EQ(found.report.floor, 1.0);
    EXPECT_EQ(found.report.standing, 1u);
    EXPECT_THAT(namesOf(found.report.letDown), ElementsAre("C", "B"));
    EXPECT_NEAR(found.report.greatestLetDown(), 1.8, 1e-9);
    EXPECT_THAT(found.report.hovering, IsEmpty());
    EXPECT_THAT(found.report.warnings, IsEmpty());
    EXPECT_THAT(found.report.notes, ElementsAre(AllOf(HasSubstr("2 bodies"), HasSubstr("'C' by 1.8 m"))));
    for (const std::string name : {"A", "B", "C"})
    {
      EXPECT_EQ(boxOf(found.surface, name).min[2], 1.0);
      EXPECT_EQ(boxOf(found.surface, name).max[2], boxOf(surface, name).max[2]);
    }
    EXPECT_EQ(planSite(found.surface, found.site, {}).domain.bounds.min[2], 1.0);
  }
}

/// Steps of one body, and of bodies that touch, as terraced houses.
TEST_P(Turned, StepsAreLetDown)
{
  TriangleSurface solid;
  addProfile(solid, "Row", {{0, 9}, {0, 0}, {10, 0}, {10, 0.4}, {20, 0.4}, {20, 1.5}, {30, 1.5}, {30, 9}}, 0, 12);
  TriangleSurface row;
  addHouse(row, "A", 0, 0, 0.0, 9.0);
  addHouse(row, "B", 10, 0, 0.4, 9.4);
  addHouse(row, "C", 20, 0, 1.5, 10.5);
  for (TriangleSurface* surface : {&solid, &row})
  {
    turn(*surface, GetParam());
    const GroundedModel found = ground(*surface);
    EXPECT_EQ(found.report.floor, 0.0);
    EXPECT_NEAR(found.report.greatestLetDown(), 1.5, 1e-9);
    EXPECT_THAT(found.report.warnings, IsEmpty());
    for (const auto& triangle : found.surface.triangles)
    {
      for (const Index p : triangle)
      {
        const double z = found.surface.points[p][2];
        EXPECT_TRUE(z == 0.0 || z >= 9.0) << z;
      }
    }
  }
}

TEST_P(Turned, ShellsOfRoomsStayAsDrawn)
{
  TriangleSurface surface;
  addBox(surface, "Outer", {Vec3(0, 0, 0), Vec3(10, 8, 6)});
  addBox(surface, "Inner", {Vec3(0.3, 0.3, 0.4), Vec3(9.7, 7.7, 5.6)});
  addBox(surface, "Table", {Vec3(2, 2, 0.4), Vec3(4, 3, 1.2)});
  addBox(surface, "Neighbor", {Vec3(20, 0, 0.4), Vec3(30, 8, 6)});
  turn(surface, GetParam());
  const GroundedModel found = ground(surface);
  EXPECT_THAT(namesOf(found.report.letDown), ElementsAre("Neighbor"));
  EXPECT_EQ(boxOf(found.surface, "Inner").min[2], 0.4);
  EXPECT_EQ(boxOf(found.surface, "Table").min[2], 0.4);
  EXPECT_THAT(found.report.hovering, IsEmpty());
}

TEST_P(Turned, WhatHoversHighStaysAsDrawn)
{
  TriangleSurface surface;
  addHouse(surface, "West", 0, 0, 0, 30);
  addHouse(surface, "East", 30, 0, 0, 30);
  addBox(surface, "Bridge", {Vec3(10, 4, 20), Vec3(30, 6, 23)});
  addBox(surface, "Balcony", {Vec3(0, -1.5, 3), Vec3(10, 0, 4.2)});
  addBox(surface, "Canopy", {Vec3(40, 0, 3), Vec3(45, 10, 3.2)});
  addBox(surface, "Roof", {Vec3(-30, 0, 3), Vec3(-20, 10, 15)}); // on posts
  for (const double x : {-30.0, -20.3})
  {
    for (const double y : {0.0, 9.7})
    {
      addBox(surface, "Post", {Vec3(x, y, 0), Vec3(x + 0.3, y + 0.3, 3)});
    }
  }
  addBox(surface, "Tower", {Vec3(0, 30, 4), Vec3(20, 50, 60)}); // above an open ground floor
  addBox(surface, "Core", {Vec3(8, 38, 0), Vec3(12, 42, 4)});
  addBox(surface, "Wing", {Vec3(20, 30, 4), Vec3(30, 50, 60)}); // hangs at the tower
  addSphere(surface, "Ball", Vec3(-10, -20, 2.2), 2.0, 3);
  turn(surface, GetParam());
  const GroundedModel found = ground(surface);
  EXPECT_EQ(found.report.floor, 0.0);
  EXPECT_TRUE(isAsDrawn(surface, found)) << ::testing::PrintToString(namesOf(found.report.letDown));
  EXPECT_THAT(found.report.letDown, IsEmpty());
  EXPECT_THAT(found.report.warnings, IsEmpty());
}

TEST_P(Turned, WindowsDoorsAndNichesStayOpen)
{
  TriangleSurface surface;
  addHouse(surface, "Other", 30, 0, 0, 12);
  // A wall ring with a door, a slot at its foot, and a niche below the upper floor.
  addSurface(surface, "Wall",
             {{0, 0, 0},
              {4, 0, 0},
              {4, 0, 2.2},
              {6, 0, 2.2},
              {6, 0, 0},
              {8, 0, 0},
              {8, 0, 0.3},
              {9, 0, 0.3},
              {9, 0, 0},
              {10, 0, 0},
              {10, 0, 30},
              {0, 0, 30},
              {10, 10, 0},
              {10, 10, 30},
              {0, 10, 0},
              {0, 10, 30}},
             {{0, 1, 2},
              {0, 2, 11},
              {2, 3, 11},
              {3, 10, 11},
              {3, 6, 10},
              {3, 4, 6},
              {4, 5, 6},
              {6, 7, 10},
              {7, 9, 10},
              {7, 8, 9},
              {9, 12, 13},
              {9, 13, 10},
              {12, 14, 15},
              {12, 15, 13},
              {14, 0, 11},
              {14, 11, 15},
              {11, 10, 13},
              {11, 13, 15}});
  addProfile(surface, "Niche", {{50, 20}, {50, 0}, {60, 0}, {60, 0.5}, {60.4, 0.5}, {60.4, 20}}, 0, 10);
  turn(surface, GetParam());
  const GroundedModel found = ground(surface);
  EXPECT_TRUE(isAsDrawn(surface, found)) << ::testing::PrintToString(namesOf(found.report.letDown));
  EXPECT_THAT(found.report.warnings, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Ground, Turned, ::testing::Values(0.0, 17.0, 45.0));

TEST(Ground, ARatioOfZeroLeavesAllAsDrawnAndWarns)
{
  const GroundedModel found = ground(threeHouses(), withRatio(0.0));
  EXPECT_TRUE(isAsDrawn(threeHouses(), found));
  EXPECT_EQ(found.report.floor, 1.0);
  EXPECT_THAT(namesOf(found.report.hovering), ElementsAre("B", "C"));
  EXPECT_THAT(found.report.warnings, ElementsAre(AllOf(HasSubstr("thinner than an element"), HasSubstr("'B' by 0.4 m"),
                                                       Not(HasSubstr("'C'")), HasSubstr("GroundSnapRatio")),
                                                 AllOf(HasSubstr("'C' by 1.8 m"), HasSubstr("GroundSnapRatio"))));
  // By less than C hovers.
  EXPECT_THAT(namesOf(ground(threeHouses(), withRatio(0.1)).report.letDown), ElementsAre("B"));
}

TEST(Ground, OfGivenBoundsIsTheirBottom)
{
  SiteOptions options;
  options.mode = DomainMode::bounds;
  options.bounds = {Vec3(-50, -50, 1.0), Vec3(100, 60, 40)};
  const GroundedModel found = ground(threeHouses(), options);
  EXPECT_TRUE(isAsDrawn(threeHouses(), found));
  EXPECT_THAT(found.report.warnings, ElementsAre(AllOf(HasSubstr("'B' by 0.4 m"), HasSubstr("DomainBounds"))));
  options.bounds.min[2] = 2.8;
  EXPECT_THAT(ground(threeHouses(), options).report.warnings, IsEmpty());
  EXPECT_THAT(ground(threeHouses(), options).report.belowGround, SizeIs(2));
  // Of a room nothing is asked.
  options.mode = DomainMode::surfaces;
  EXPECT_TRUE(isAsDrawn(threeHouses(), ground(threeHouses(), options)));
}

TEST(Ground, IsWhereMostStandsAndCellarsAreBelow)
{
  TriangleSurface surface;
  for (int i = 0; i < 8; ++i)
  {
    addHouse(surface, "House" + std::to_string(i), 15 * i, 0, i % 4 == 1 ? 0.05 : 0.0, 9);
  }
  addHouse(surface, "WithCellar", 0, 20, -3, 6);
  addBox(surface, "Garage", {Vec3(15, -1, -4), Vec3(41, 11, -0.5)}); // below two houses
  const GroundedModel found = ground(surface);
  EXPECT_EQ(found.report.floor, 0.0);
  EXPECT_THAT(namesOf(found.report.belowGround), ElementsAre("Garage", "WithCellar"));
  EXPECT_THAT(namesOf(found.report.letDown), UnorderedElementsAre("House1", "House5"));
  EXPECT_THAT(found.report.notes, Contains(AllOf(HasSubstr("below the ground"), HasSubstr("'Garage' by 4 m"))));
  EXPECT_THAT(found.report.warnings, IsEmpty());
  // A house alone with its cellar stands on that.
  TriangleSurface alone;
  addHouse(alone, "House", 0, 0, -3, 6);
  EXPECT_EQ(ground(alone).report.floor, -3.0);
}

TEST(Ground, BesideBuildingsStaysBelowThem)
{
  // A lawn that has no name.
  TriangleSurface surface = threeHouses();
  addSheet(surface, "Lawn", Vec3(-30, -30, 0.6), Vec3(120, 0, 0), Vec3(0, 70, 0));
  EXPECT_EQ(ground(surface).report.floor, 0.6);
  // Nothing stands upon anything.
  TriangleSurface sheet;
  addSheet(sheet, "Fence", Vec3(0, 0, 2), Vec3(9, 0, 0), Vec3(0, 0, 3));
  EXPECT_EQ(ground(sheet).report.floor, 2.0);
  EXPECT_THAT(ground({}).report.letDown, IsEmpty());
}

TEST(Ground, BodiesGoDownToASite)
{
  TriangleSurface surface;
  addSheet(surface, "Site", Vec3(-30, -30, 0.5), Vec3(120, 0, 0), Vec3(0, 70, 0));
  surface.points.reserve(100);
  TriangleSurface houses = threeHouses();
  for (const std::string name : {"A", "B", "C"})
  {
    const Box3 box = boxOf(houses, name);
    addBox(surface, name, box);
  }
  for (const DomainMode mode : {DomainMode::automatic, DomainMode::site})
  {
    SiteOptions options;
    options.mode = mode;
    options.groundSnapRatio = 0.3;
    const GroundedModel found = ground(surface, options);
    EXPECT_THAT(namesOf(found.report.letDown), ElementsAre("C", "B", "A"));
    EXPECT_EQ(boxOf(found.surface, "C").min[2], 0.5);
  }
}

TEST(Ground, BodiesOnASlopeGoBelowTerrain)
{
  TriangleSurface surface;
  addSheet(surface, "Terrain", Vec3(-60, -60, 0), Vec3(150, 0, 15), Vec3(0, 120, 0)); // 10 % up
  SiteOptions options;
  options.terrain = "Terrain";
  addHouse(surface, "Half", 0, 0, 6.5, 15);   // over 6 to 7
  addHouse(surface, "Above", 20, 0, 9.5, 18); // over 8 to 9
  addHouse(surface, "Sunk", 40, 0, 9.5, 18);  // over 10 to 11
  addHouse(surface, "High", 60, 0, 16.5, 24); // over 12 to 13
  const GroundedModel found = ground(surface, options);
  EXPECT_THAT(namesOf(found.report.letDown), ElementsAre("Above", "Half"));
  EXPECT_NEAR(found.report.letDown[0].distance, 1.5, 1e-9);
  EXPECT_NEAR(found.report.letDown[1].distance, 0.5, 1e-9);
  EXPECT_LT(boxOf(found.surface, "Half").min[2], 6.0);
  EXPECT_LT(boxOf(found.surface, "Above").min[2], 8.0);
  EXPECT_EQ(boxOf(found.surface, "Sunk").min[2], 9.5);
  EXPECT_THAT(namesOf(found.report.hovering), ElementsAre("High"));
  EXPECT_THAT(found.report.belowGround, IsEmpty());
  EXPECT_EQ(boxOf(found.surface, "Terrain").min[2], 0.0);
}

TEST(Ground, OfBodiesThatShareItsPointsIsLeftAlone)
{
  // The house hangs at a point of the terrain.
  TriangleSurface surface;
  addSurface(surface, "Terrain", {{-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}, {0, 0, 1}},
             {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const auto first = static_cast<Index>(surface.points.size());
  addHouse(surface, "House", 0, 0, 1, 9);
  for (auto& triangle : surface.triangles)
  {
    for (Index& p : triangle)
    {
      p = p >= first && surface.points[p] == Vec3(0, 0, 1) ? 4 : p;
    }
  }
  SiteOptions options;
  options.terrain = "Terrain";
  const GroundedModel found = ground(surface, options);
  EXPECT_THAT(namesOf(found.report.letDown), ElementsAre("House"));
  EXPECT_EQ(boxOf(found.surface, "Terrain").max[2], 1.0);
  EXPECT_LT(boxOf(found.surface, "House").min[2], 0.8);
}

TEST(Ground, ASlabsUpperSideIsIt)
{
  TriangleSurface surface;
  addBox(surface, "Base", {Vec3(-50, -50, -1), Vec3(50, 50, 0)});
  addBox(surface, "B1", {Vec3(-5, -5, 0), Vec3(5, 5, 20)});
  for (const std::string name : {"Base", "Site"}) // named, or found
  {
    SiteOptions options;
    options.site = name;
    const GroundedModel found = ground(surface, options);
    EXPECT_THAT(found.report.slabs, ElementsAre("Base"));
    EXPECT_THAT(found.report.notes, ElementsAre(HasSubstr("'Base'")));
    EXPECT_EQ(boxOf(found.surface, "Base").min[2], 0.0);
    EXPECT_EQ(found.surface.triangles.size(), 2u + 12u);
    EXPECT_EQ(found.report.standing, 1u);
    const SitePlan plan = planSite(found.surface, found.site, {});
    EXPECT_FALSE(plan.hasTerrain);
    EXPECT_EQ(plan.domain.bounds.min[2], 0.0);
    EXPECT_NEAR(plan.domain.bounds.max[2], 120.0, 1e-9);
  }
  // One that is hardly wider than the house is its floor.
  TriangleSurface house;
  addBox(house, "Floor", {Vec3(-6, -6, -0.3), Vec3(6, 6, 0)});
  addBox(house, "Walls", {Vec3(-5, -5, 0), Vec3(5, 5, 6)});
  EXPECT_THAT(ground(house).report.slabs, IsEmpty());
  EXPECT_EQ(ground(house).report.floor, -0.3);
}

TEST(Ground, ASolidTerrainIsMeshedByItsUpperSide)
{
  TriangleSurface surface;
  // Hills with a pit, on a block.
  addProfile(surface, "Terrain",
             {{0, -9}, {60, -9}, {60, 2}, {40, 4}, {30, 1}, {30, -2}, {22, -2}, {22, 1}, {10, 3}, {0, 0}}, 0, 50);
  const double all = static_cast<double>(surface.triangles.size());
  addHouse(surface, "House", 42, 20, 3, 12);
  SiteOptions options;
  options.terrain = "Terrain";
  const GroundedModel found = ground(surface, options);
  double level = 0.0;
  double upright = 0.0;
  for (std::size_t t = 0; t < found.surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = found.surface.triangles[t];
    const auto& p = found.surface.points;
    const Eigen::Vector3d u = p[b] - p[a];
    const Eigen::Vector3d v = p[c] - p[a];
    const bool isTerrain = found.surface.names[found.surface.surfaceIds[t]] == "Terrain";
    level += isTerrain ? 0.5 * (u[0] * v[1] - u[1] * v[0]) : 0.0;
    upright += isTerrain ? 0.5 * std::abs(u[1] * v[2] - u[2] * v[1]) : 0.0;
  }
  EXPECT_LT(found.surface.triangles.size(), all + 12);
  EXPECT_NEAR(level, 60.0 * 50.0, 1e-6) << "of the upper side alone";
  EXPECT_GT(upright, 2 * 3.0 * 50.0) << "with the walls of the pit";
  EXPECT_NO_THROW(placeModel(found.surface, planSite(found.surface, found.site, {}), GridOptions()));
}

TEST(Ground, NamesOfTheFileAreTerrainWhereTheyCoverIt)
{
  TriangleSurface surface;
  addSheet(surface, "Land", Vec3(-60, -60, 0), Vec3(120, 0, 6), Vec3(0, 60, 0));
  addSheet(surface, "Water", Vec3(-60, 0, 0), Vec3(120, 0, 6), Vec3(0, 60, 0));
  addHouse(surface, "House", 0, 0, 3, 12);
  SiteOptions options;
  options.grounds = {"Land", "Water"};
  const SitePlan plan = groundOf(surface, options, sizeMin);
  EXPECT_TRUE(plan.hasTerrain);
  EXPECT_THAT(plan.isGround, ElementsAre(1, 1, 0));
  // A path is no terrain.
  TriangleSurface path;
  addSheet(path, "Land", Vec3(-60, -60, 0), Vec3(120, 0, 6), Vec3(0, 3, 0));
  addHouse(path, "House", 0, 0, 0, 12);
  EXPECT_FALSE(groundOf(path, options, sizeMin).hasTerrain);
  EXPECT_THAT(groundOf(path, options, sizeMin).isGround, ElementsAre(1, 0));
}

TEST(Ground, ZonesStayAsDrawn)
{
  TriangleSurface surface;
  addHouse(surface, "House", 0, 0, 0, 10);
  addHouse(surface, "Crown", 30, 0, 2, 12);
  ModelOptions options;
  EXPECT_THAT(namesOf(groundModel(surface, options).report.letDown), ElementsAre("Crown"));
  options.cellZones = {"Cr*"};
  EXPECT_THAT(groundModel(surface, options).report.letDown, IsEmpty());
  EXPECT_THAT(groundModel(surface, options).report.warnings, IsEmpty());
}

TEST(Ground, OfOctantsThatAreGivenIsTheirs)
{
  ModelOptions options;
  options.sizes.sizeMin = sizeMin;
  EXPECT_THAT(groundModel(threeHouses(), options, 1.0).report.letDown, SizeIs(2));
  const GroundedInput found = groundModel(threeHouses(), options, -1.0);
  EXPECT_THAT(found.report.letDown, IsEmpty());
  EXPECT_EQ(found.report.hovering.size(), 3u);
}

} // namespace
