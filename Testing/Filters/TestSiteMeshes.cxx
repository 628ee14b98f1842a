// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of domains that stand turned, of grids that are turned, and above terrain.
#include "DualMesherTest.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaOctreeSource.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>

#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace {

using atria::Box3;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::addSurface;
using atria::testing::areaOf;
using atria::testing::identical;
using atria::testing::namesOf;
using atria::testing::setGrid;
using atria::testing::volumeOf;
using ::testing::Contains;
using ::testing::ElementsAre;

Vec3 turned(const Vec3& p, double degrees)
{
  return Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, Vec3::UnitZ()) * p;
}

class SiteMeshes : public atria::testing::DualMesherTest
{
protected:
  void mesh(const TriangleSurface& surface)
  {
    setSurface(surface);
    mesher->Update();
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    EXPECT_TRUE(atria::testing::patchesAreTheBoundary(volume(), patches()));
    EXPECT_NEAR(atria::testing::enclosedVolume(patches()), meshVolume(), 1e-9 * volumeOf(domain));
  }

  /// The bare sides are there under their names, with the areas of the domain's box.
  void expectSides(double tolerance)
  {
    const auto all = namedPatches();
    const Vec3 s = domain.size();
    for (const auto& [name, area] :
         {std::pair("xMin", s[1] * s[2]), std::pair("xMax", s[1] * s[2]), std::pair("yMin", s[0] * s[2]),
          std::pair("yMax", s[0] * s[2]), std::pair("zMax", s[0] * s[1])})
    {
      ASSERT_THAT(namesOf(all), Contains(name));
      EXPECT_NEAR(areaOf(all.at(name)), area, tolerance * area) << name;
      EXPECT_EQ(all.at(name)->GetCellData()->GetArray("SurfaceId")->GetRange()[1], -1.0);
    }
  }

  /// Of the lateral sides' vertices that are not on their planes, how far they are from these.
  std::vector<double> distancesFromSides(double angle)
  {
    std::vector<double> away;
    const Vec3 half = 0.5 * domain.size();
    const auto all = namedPatches();
    for (const auto& [name, axis] :
         {std::pair("xMin", 0), std::pair("xMax", 0), std::pair("yMin", 1), std::pair("yMax", 1)})
    {
      vtkPolyData* patch = all.at(name);
      for (vtkIdType i = 0; i < patch->GetNumberOfPoints(); ++i)
      {
        const Vec3 p = turned(Vec3(patch->GetPoint(i)) - domain.center(), -angle);
        const double distance = half[axis] - std::abs(p[axis]);
        EXPECT_GT(distance, -1e-6);
        if (distance > 1e-6)
        {
          away.push_back(distance);
        }
      }
    }
    return away;
  }

  std::size_t detachedVertices()
  {
    const std::vector<std::string> names = atria::testing::fieldStrings(diagnostics(), "DiagnosticName");
    vtkDataArray* kinds = diagnostics()->GetCellData()->GetArray("Diagnostic");
    std::size_t count = 0;
    for (vtkIdType i = 0; i < kinds->GetNumberOfTuples(); ++i)
    {
      count += names[static_cast<std::size_t>(kinds->GetTuple1(i))] == "DetachedVertex" ? 1 : 0;
    }
    return count;
  }
};

TEST_F(SiteMeshes, ATurnedBareDomainIsExact)
{
  for (const double angle : {10.0, 45.0, -30.0, 90.0, 137.0})
  {
    SCOPED_TRACE(angle);
    mesher->SetDomainAngle(angle);
    mesh({});
    EXPECT_EQ(namesOf(namedPatches()).size(), 6u);
    expectSides(1e-7);
    EXPECT_NEAR(meshVolume(), volumeOf(domain), 1e-7 * volumeOf(domain));
    // xMin looks against the domain's x axis.
    Box3 side;
    vtkPolyData* patch = namedPatches().at("xMin");
    for (vtkIdType i = 0; i < patch->GetNumberOfPoints(); ++i)
    {
      side.extend(turned(Vec3(patch->GetPoint(i)) - domain.center(), -angle));
    }
    EXPECT_NEAR(side.min[0], -0.5 * domain.size()[0], 1e-6);
    EXPECT_NEAR(side.max[0], -0.5 * domain.size()[0], 1e-6);
  }
}

TEST_F(SiteMeshes, ATurnedDomainKeepsBuildingsAndItsGround)
{
  domain = {Vec3(-10, -10, 0), Vec3(10, 10, 8)};
  setGrid(mesher, domain, 0.5, 1.0, 2.0);
  const Box3 building{Vec3(-1.7, -1.9, -1), Vec3(2.6, 1.4, 4.1)};
  TriangleSurface surface;
  addSheet(surface, "Site", Vec3(-30, -30, 0), Vec3(60, 0, 0), Vec3(0, 60, 0));
  addBox(surface, "Building", building);
  mesher->SetDomainAngle(25.0);
  mesh(surface);
  expectSides(1e-6);
  const double inside = 4.3 * 3.3 * 4.1;
  EXPECT_NEAR(meshVolume(), volumeOf(domain) - inside, 1e-3 * inside);
  EXPECT_NEAR(areaOf(namedPatches().at("Site")), 400.0 - 4.3 * 3.3, 1e-6 * 400.0);
  EXPECT_THAT(atria::testing::fieldStrings(diagnostics(), "SurfaceWithoutFaces"), ::testing::IsEmpty());
  EXPECT_THAT(atria::testing::fieldStrings(diagnostics(), "ZoneKind"),
              ::testing::UnorderedElementsAre("open", "solid", "beyond"));
}

TEST_F(SiteMeshes, SidesOfATurnedDomainDoNotRefine)
{
  domain = {Vec3(-32, -32, 0), Vec3(32, 32, 32)};
  setGrid(mesher, domain, 0.5, 1.0, 4.0);
  mesher->SupportElementsOff(); // turned sides have a layer else
  mesh({});
  const vtkIdType straight = volume()->GetNumberOfCells();
  mesher->SetDomainAngle(30.0);
  mesh({});
  EXPECT_LT(std::abs(static_cast<double>(volume()->GetNumberOfCells() - straight)),
            0.3 * static_cast<double>(straight));
}

TEST_F(SiteMeshes, ADomainThatIsNoMultipleOfTheOctantsIsExact)
{
  domain = {Vec3(-5.1, -4.27, 0), Vec3(7.03, 5.4, 6.33)};
  setGrid(mesher, domain, 0.5, 1.0, 2.0);
  mesh({});
  expectSides(1e-9);
  EXPECT_NEAR(meshVolume(), volumeOf(domain), 1e-9 * volumeOf(domain));
}

TEST_F(SiteMeshes, AlignedToWallsAHouseIsMeshedAlikeWhateverItsDirection)
{
  TriangleSurface house;
  const Box3 walls{Vec3(-3, -2, 0), Vec3(3, 2, 3)};
  addBox(house, "House", walls);
  addSheet(house, "Canopy", Vec3(3, -1, 2.3), Vec3(1.6, 0, 0), Vec3(0, 2, 0));
  addSheet(house, "Site", Vec3(-12, -9, 0), Vec3(24, 0, 0), Vec3(0, 18, 0));
  domain = {Vec3(-12, -9, 0), Vec3(12, 9, 8)};
  setGrid(mesher, domain, 0.5, 1.0, 2.0);
  mesher->SetAlignGrid(vtkAtriaDualMesher::ToWalls);
  mesh(house);
  const vtkIdType cells = volume()->GetNumberOfCells();
  std::vector<Vec3> straight;
  for (vtkIdType i = 0; i < volume()->GetNumberOfPoints(); ++i)
  {
    straight.emplace_back(volume()->GetPoint(i));
  }
  for (const double angle : {17.0, 30.0, -41.0})
  {
    SCOPED_TRACE(angle);
    TriangleSurface other = house;
    atria::testing::turn(other, angle);
    mesher->SetDomainAngle(angle);
    mesh(other);
    EXPECT_EQ(volume()->GetNumberOfCells(), cells);
    ASSERT_EQ(volume()->GetNumberOfPoints(), static_cast<vtkIdType>(straight.size()));
    double farthest = 0.0;
    for (vtkIdType i = 0; i < volume()->GetNumberOfPoints(); ++i)
    {
      farthest = std::max(farthest, (Vec3(volume()->GetPoint(i)) - turned(straight[i], angle)).norm());
    }
    EXPECT_LT(farthest, 1e-8);
    expectSides(1e-9);
    // The model's corners are points of the mesh, along the model's axes.
    vtkPolyData* patch = namedPatches().at("House");
    for (int corner = 4; corner < 8; ++corner)
    {
      const Vec3 wanted = turned({corner & 1 ? 3.0 : -3.0, corner & 2 ? 2.0 : -2.0, 3.0}, angle);
      double nearest = 1.0;
      for (vtkIdType i = 0; i < patch->GetNumberOfPoints(); ++i)
      {
        nearest = std::min(nearest, (Vec3(patch->GetPoint(i)) - wanted).norm());
      }
      EXPECT_LT(nearest, 1e-8);
    }
  }
}

TEST_F(SiteMeshes, AlignedToWallsInAStraightDomainTheSidesStandTurned)
{
  domain = {Vec3(-12, -9, 0), Vec3(12, 9, 8)};
  setGrid(mesher, domain, 0.5, 1.0, 2.0);
  TriangleSurface house;
  addBox(house, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 3)});
  atria::testing::turn(house, 17.0);
  mesher->SetAlignGrid(vtkAtriaDualMesher::ToWalls);
  mesh(house);
  expectSides(1e-6);
  EXPECT_NEAR(meshVolume(), volumeOf(domain) - 6 * 4 * 3, 1e-6 * volumeOf(domain));
  // Seeds are along the model's axes.
  const vtkIdType cells = volume()->GetNumberOfCells();
  mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
  mesher->AddSeed(11.5, 8.5, 7.5);
  mesher->Update();
  EXPECT_EQ(volume()->GetNumberOfCells(), cells);
}

TEST_F(SiteMeshes, AnOctreeOfATurnedGridGivesTheSameMesh)
{
  domain = {Vec3(-12, -9, 0), Vec3(12, 9, 8)};
  TriangleSurface house;
  addBox(house, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 3)});
  atria::testing::turn(house, 17.0);
  vtkNew<vtkAtriaOctreeSource> source;
  source->SetInputDataObject(atria::testing::toPolyData(house));
  for (const int sides : {4, 7, 0})
  {
    SCOPED_TRACE(sides);
    for (auto* filter : {static_cast<vtkAtriaGridAlgorithm*>(source), static_cast<vtkAtriaGridAlgorithm*>(mesher)})
    {
      setGrid(filter, domain, 0.5, 1.0, 2.0);
      filter->SetAlignGrid(vtkAtriaDualMesher::ToWalls);
      filter->SetDomainSides(sides == 0 ? 4 : sides);
      for (const auto& [x, y] :
           {std::pair(-11.0, -8.0), std::pair(12.0, -5.0), std::pair(9.0, 8.0), std::pair(-8.0, 9.0)})
      {
        sides == 0 ? filter->AddDomainCorner(x, y) : void(); // another quadrilateral than the box
      }
    }
    setSurface(house);
    const auto alone = copiesOfOutputs();
    vtkNew<vtkAtriaDualMesher> second;
    second->SetInputDataObject(0, atria::testing::toPolyData(house));
    second->SetInputConnection(1, source->GetOutputPort());
    second->Update();
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    EXPECT_TRUE(identical(alone[0], second->GetOutputDataObject(0)));
    EXPECT_TRUE(identical(alone[1], second->GetOutputDataObject(1)));
  }
}

TEST_F(SiteMeshes, APrismHasPatchesOfItsSides)
{
  mesher->SetDomainSides(5);
  mesh({});
  EXPECT_THAT(namesOf(namedPatches()),
              ElementsAre("domainSide1", "domainSide2", "domainSide3", "domainSide4", "domainSide5", "zMax", "zMin"));
}

TEST_F(SiteMeshes, APolygonGivesTheDomainItsSides)
{
  setGrid(mesher, domain, 0.5, 1.0, 2.0);
  for (const auto& [x, y] :
       {std::pair(0.0, 0.0), std::pair(3.0, 9.0), std::pair(12.0, 7.0), std::pair(10.0, -4.0)}) // clockwise
  {
    mesher->AddDomainCorner(x, y);
  }
  ASSERT_EQ(mesher->GetNumberOfDomainCorners(), 4);
  mesh({});
  EXPECT_THAT(namesOf(namedPatches()),
              ElementsAre("domainSide1", "domainSide2", "domainSide3", "domainSide4", "zMax", "zMin"));
  const double height = domain.size()[2];
  // By the first corner, from which the sides go round the other way.
  EXPECT_NEAR(areaOf(namedPatches().at("domainSide1")), std::hypot(10.0, 4.0) * height, 1e-6 * height);
  EXPECT_NEAR(areaOf(namedPatches().at("domainSide4")), std::hypot(3.0, 9.0) * height, 1e-6 * height);
  const double ground = 0.5 * (12.0 * 9.0 - 3.0 * 7.0 + 10.0 * 7.0 + 12.0 * 4.0);
  EXPECT_NEAR(meshVolume(), ground * height, 1e-6 * ground * height);
  mesher->RemoveAllDomainCorners();
  mesh({});
  EXPECT_EQ(namesOf(namedPatches()).size(), 6u);
  EXPECT_NEAR(meshVolume(), volumeOf(domain), 1e-7 * volumeOf(domain));
}

TEST_F(SiteMeshes, ThePolygonOfAnAutomaticDomainHasItsHeight)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(-2, -2, 1), Vec3(2, 2, 4)});
  mesher->SetDomainModeToAutomatic();
  for (const auto& [x, y] : {std::pair(-20.0, -20.0), std::pair(20.0, -20.0), std::pair(0.0, 25.0)})
  {
    mesher->AddDomainCorner(x, y);
  }
  mesher->SetInputDataObject(atria::testing::toPolyData(surface));
  mesher->Update();
  EXPECT_EQ(volume()->GetBounds()[4], 1.0);
  EXPECT_EQ(volume()->GetBounds()[5], 4.0 + 5.0 * 3.0);
  mesher->SetDomainAngle(10.0);
  mesher->Update();
  EXPECT_THAT(atria::testing::firstOf(messages.takeErrors()), ::testing::HasSubstr("DomainPolygon or DomainAngle"));
  mesher->SetDomainAngle(0.0);
  mesher->AddDomainCorner(0.0, 0.0);
  mesher->Update();
  EXPECT_THAT(atria::testing::firstOf(messages.takeErrors()), ::testing::HasSubstr("not convex at corner 4 (0, 0)"));
}

/// About a circle a polygon of n sides has the area n r^2 tan(pi / n).
TEST_F(SiteMeshes, ACylinderIsMeshedByThePrismAboutIt)
{
  setGrid(mesher, domain, 0.5, 1.0, 2.0);
  mesher->SetDomainSides(8);
  mesher->SetDomainCylinder(3.0, -2.0, 10.0, 1.0, 9.0);
  mesh({});
  const double exact = 8.0 * 100.0 * std::tan(std::numbers::pi / 8.0) * 8.0;
  EXPECT_NEAR(meshVolume(), exact, 1e-7 * exact);
}

TEST_F(SiteMeshes, SidesTooNarrowForTheElementsAreWarnedOf)
{
  setGrid(mesher, domain, 0.5, 1.0, 4.0);
  mesher->SetDomainSides(48);
  mesh({});
  EXPECT_THAT(atria::testing::firstOf(messages.takeWarnings()), ::testing::HasSubstr("fewer sides"));
}

TEST_F(SiteMeshes, AHyperTreeGridIsNotTurned)
{
  vtkNew<vtkAtriaOctreeSource> source;
  setGrid(source, domain, 0.5, 1.0, 2.0);
  source->SetDomainAngle(17.0);
  source->SetAlignGrid(vtkAtriaOctreeSource::ToDomain);
  source->SetOutputType(vtkAtriaOctreeSource::HyperTreeGrid);
  source->Update();
  EXPECT_THAT(atria::testing::firstOf(messages.takeErrors()), ::testing::HasSubstr("cannot be turned"));
}

/// A ridge along x at y = 3, with slopes to both sides, on a square that stops short of the domain.
TriangleSurface ridge()
{
  TriangleSurface surface;
  addSurface(surface, "Terrain", {{-6, -6, 0}, {6, -6, 0}, {6, 3, 3}, {-6, 3, 3}, {6, 6, 1.5}, {-6, 6, 1.5}},
             {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}});
  return surface;
}

/// Of the space above the ridge, extended level, in a box of height h from 0 that reaches from -a to a in x, -b to b in
/// y.
double volumeAboveRidge(double a, double b, double height)
{
  const double below = 9.0 * 1.5 + 3.0 * 2.25 + (b - 6.0) * 1.5;
  return 2.0 * a * (2.0 * b * height - below);
}

TEST_F(SiteMeshes, AboveTerrainTheVolumeIsExactAndNothingIsBelow)
{
  domain = {Vec3(-10, -9, 0), Vec3(10, 9, 12)};
  setGrid(mesher, domain, 0.5, 1.0, 2.0);
  mesher->SetTerrainName("Terr*");
  for (const auto alignment : {vtkAtriaDualMesher::ToAxes, vtkAtriaDualMesher::ToDomain})
  {
    mesher->SetAlignGrid(alignment);
    mesh(ridge());
    EXPECT_NEAR(meshVolume(), volumeAboveRidge(10, 9, 12), 1e-3 * meshVolume());
    EXPECT_THAT(namesOf(namedPatches()), ElementsAre("Terrain", "xMax", "xMin", "yMax", "yMin", "zMax"));
  }
}

TEST_F(SiteMeshes, TerrainClosesOffTurnedSides)
{
  domain = {Vec3(-10, -9, 0), Vec3(10, 9, 12)};
  setGrid(mesher, domain, 0.5, 1.0, 2.0);
  mesher->SetTerrainName("Terrain");
  TriangleSurface surface = ridge();
  atria::testing::turn(surface, 20.0);
  mesher->SetDomainAngle(20.0);
  mesh(surface);
  EXPECT_THAT(namesOf(namedPatches()), ElementsAre("Terrain", "xMax", "xMin", "yMax", "yMin", "zMax"));
  EXPECT_NEAR(meshVolume(), volumeAboveRidge(10, 9, 12), 2e-3 * meshVolume());
}

TEST_F(SiteMeshes, AnAutomaticDomainStandsAlongTheWind)
{
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(-3, -2, 0), Vec3(3, 2, 3)});
  addSheet(surface, "Site", Vec3(-300, -300, 0), Vec3(600, 0, 0), Vec3(0, 600, 0));
  mesher->SetDomainMode(vtkAtriaDualMesher::Automatic);
  mesher->SetWindAngle(30.0);
  const double c = std::cos(std::numbers::pi / 6.0), s = 0.5;
  const Vec3 half(3 * c + 2 * s, 3 * s + 2 * c, 0);
  domain = {Vec3(-half[0] - 15, -half[1] - 15, 0), Vec3(half[0] + 45, half[1] + 15, 18)};
  mesh(surface);
  // The site refines to it, so that levels change along the upright edges.
  expectSides(1e-6);
  EXPECT_NEAR(meshVolume(), volumeOf(domain) - 6 * 4 * 3, 1e-6 * volumeOf(domain));
}

/// Octants of several sizes meet at the sides, and some elements would have all of their vertices on one side: there
/// vertices leave it, by less than an octant, and are told.
TEST_F(SiteMeshes, WhereElementsAtTurnedSidesNeedRoomVerticesLeaveTheseAndAreTold)
{
  domain = {Vec3(-28, -27, 0), Vec3(66, 31, 40)};
  setGrid(mesher, domain, 0.5, 1.0, 8.0);
  TriangleSurface surface;
  addBox(surface, "House", {Vec3(-6, -4, 0), Vec3(5, 4, 6)});
  addSheet(surface, "Site", Vec3(-55, -45, 0), Vec3(105, 0, 0), Vec3(0, 95, 0));
  for (const double angle : {20.0, 30.0, 45.0, 110.0})
  {
    SCOPED_TRACE(angle);
    mesher->SetDomainAngle(angle);
    mesh(surface);
    vtkNew<vtkAtriaMeshQuality> quality;
    quality->SetInputConnection(mesher->GetOutputPort());
    quality->Update();
    EXPECT_EQ(quality->GetNumberOfInvalidCells(), 0);
    EXPECT_NEAR(meshVolume(), volumeOf(domain) - 11 * 8 * 6, 1e-4 * volumeOf(domain));
    const std::vector<double> away = distancesFromSides(angle);
    EXPECT_LE(away.size(), detachedVertices());
    EXPECT_THAT(away, ::testing::Each(::testing::Lt(8.0)));
  }
}

TEST_F(SiteMeshes, AnAutomaticDomainNeedsBuildings)
{
  TriangleSurface surface;
  addSheet(surface, "Site", Vec3(-3, -3, 0), Vec3(6, 0, 0), Vec3(0, 6, 0));
  setSurface(surface);
  mesher->SetDomainMode(vtkAtriaDualMesher::Automatic);
  mesher->Update();
  EXPECT_THAT(atria::testing::firstOf(messages.takeErrors()), ::testing::HasSubstr("no buildings"));
  expectEmpty();
}

} // namespace
