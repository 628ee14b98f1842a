// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh and its patches, for surfaces of which areas and volumes are known.
#include "DualMesherTest.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkIdList.h>
#include <vtkPointData.h>

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <tuple>

namespace {

using atria::Box3;
using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using atria::testing::areaOf;
using atria::testing::namesOf;
using atria::testing::volumeOf;
using ::testing::ElementsAre;

const Box3 building{Vec3(-1.7, -1.9, 1.2), Vec3(2.6, 1.4, 4.1)};

/// Surfaces are rounded to the lattice, some 1e-9 of the finest octants.
constexpr double rounding = 1e-7;

double areaOfBox(const Box3& box)
{
  const Vec3 s = box.size();
  return 2.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]);
}

TriangleSurface closedBox()
{
  TriangleSurface surface;
  addBox(surface, "Building", building);
  return surface;
}

class DualMesher : public atria::testing::DualMesherTest
{
protected:
  /// What holds whatever the surfaces are.
  void expectClosedPatches()
  {
    EXPECT_TRUE(atria::testing::patchesAreTheBoundary(volume(), patches()));
    EXPECT_NEAR(atria::testing::enclosedVolume(patches()), meshVolume(), 1e-9 * volumeOf(domain));
  }

  void mesh(const TriangleSurface& surface)
  {
    setSurface(surface);
    mesher->Update();
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    expectClosedPatches();
  }
};

TEST_F(DualMesher, SidesOfABareDomainAreNamedAndExact)
{
  mesh({});
  const auto all = namedPatches();
  EXPECT_THAT(namesOf(all), ElementsAre("xMax", "xMin", "yMax", "yMin", "zMax", "zMin"));
  const Vec3 s = domain.size();
  EXPECT_NEAR(areaOf(all.at("xMin")), s[1] * s[2], 1e-9);
  EXPECT_NEAR(areaOf(all.at("yMax")), s[0] * s[2], 1e-9);
  EXPECT_NEAR(areaOf(all.at("zMin")), s[0] * s[1], 1e-9);
  EXPECT_NEAR(meshVolume(), volumeOf(domain), 1e-9 * volumeOf(domain));
}

TEST_F(DualMesher, WallsOfARoomThatIsTheDomainAreItsPatchesWithExactAreas)
{
  const Vec3 s = domain.size();
  const Vec3 x(s[0], 0, 0), y(0, s[1], 0), z(0, 0, s[2]);
  TriangleSurface room;
  addSheet(room, "Floor", domain.min, x, y);
  addSheet(room, "Ceiling", domain.min + z, x, y);
  addSheet(room, "South", domain.min, x, z);
  addSheet(room, "North", domain.min + y, x, z);
  addSheet(room, "West", domain.min, y, z);
  addSheet(room, "East", domain.min + x, y, z);
  mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
  mesh(room);
  const auto all = namedPatches();
  EXPECT_THAT(namesOf(all), ElementsAre("Ceiling", "East", "Floor", "North", "South", "West"));
  EXPECT_NEAR(areaOf(all.at("Floor")), s[0] * s[1], 1e-9);
  EXPECT_NEAR(areaOf(all.at("Ceiling")), s[0] * s[1], 1e-9);
  EXPECT_NEAR(areaOf(all.at("North")), s[0] * s[2], 1e-9);
  EXPECT_NEAR(areaOf(all.at("East")), s[1] * s[2], 1e-9);
  EXPECT_NEAR(meshVolume(), volumeOf(domain), 1e-9 * volumeOf(domain));
}

TEST_F(DualMesher, TheInsideOfAClosedBoxIsDroppedByDefault)
{
  mesh(closedBox());
  const auto all = namedPatches();
  EXPECT_THAT(namesOf(all), ElementsAre("Building", "xMax", "xMin", "yMax", "yMin", "zMax", "zMin"));
  EXPECT_NEAR(areaOf(all.at("Building")), areaOfBox(building), 1e-9 * areaOfBox(building));
  EXPECT_NEAR(meshVolume(), volumeOf(domain) - volumeOf(building), 1e-9 * volumeOf(domain));
  EXPECT_EQ(all.at("Building")->GetCellData()->GetArray("Side")->GetRange()[1], 0.0);
}

TEST_F(DualMesher, AllZonesFillTheDomain)
{
  mesher->SetZoneRule(vtkAtriaDualMesher::All);
  mesh(closedBox());
  const auto all = namedPatches();
  EXPECT_NEAR(areaOf(all.at("Building_front")), areaOfBox(building), 1e-9 * areaOfBox(building));
  EXPECT_NEAR(areaOf(all.at("Building_back")), areaOfBox(building), 1e-9 * areaOfBox(building));
  EXPECT_NEAR(meshVolume(), volumeOf(domain), 1e-9 * volumeOf(domain));
  const std::vector<double> volumes = atria::testing::volumesOf(volume(), patches());
  double outside = 0.0;
  for (vtkIdType cell = 0; cell < volume()->GetNumberOfCells(); ++cell)
  {
    const double zone = volume()->GetCellData()->GetArray("ZoneId")->GetComponent(cell, 0);
    ASSERT_TRUE(zone == 0.0 || zone == 1.0);
    outside += zone == 0.0 ? volumes[cell] : 0.0;
  }
  EXPECT_NEAR(outside, volumeOf(domain) - volumeOf(building), 1e-9 * volumeOf(domain));
}

TEST_F(DualMesher, SeedsChooseZones)
{
  mesher->SetZoneRule(vtkAtriaDualMesher::All);
  setSurface(closedBox());
  const auto both = copiesOfOutputs();
  mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
  mesher->AddSeed(0, 0, 2);
  mesh(closedBox());
  const auto all = namedPatches();
  EXPECT_THAT(namesOf(all), ElementsAre("Building"));
  EXPECT_EQ(all.at("Building")->GetCellData()->GetArray("Side")->GetRange()[0], 1.0);
  EXPECT_NEAR(meshVolume(), volumeOf(building), 1e-9 * volumeOf(domain));
  mesher->AddSeed(6, 4, 5);
  expectOutputs(both);
}

TEST_F(DualMesher, SurfaceOnADomainSideNamesIt)
{
  TriangleSurface ground;
  addSheet(ground, "Ground", Vec3(-20, -20, 0), Vec3(40, 0, 0), Vec3(0, 40, 0));
  mesh(ground);
  const auto all = namedPatches();
  EXPECT_THAT(namesOf(all), ElementsAre("Ground", "xMax", "xMin", "yMax", "yMin", "zMax"));
  EXPECT_NEAR(areaOf(all.at("Ground")), domain.size()[0] * domain.size()[1], 1e-9);
}

TEST_F(DualMesher, TwoSurfacesShareADomainSide)
{
  constexpr double border = 1.3;
  TriangleSurface ground;
  addSheet(ground, "Lawn", Vec3(-5, -4, 0), Vec3(border + 5, 0, 0), Vec3(0, 9, 0));
  addSheet(ground, "Paving", Vec3(border, -4, 0), Vec3(7 - border, 0, 0), Vec3(0, 9, 0));
  mesh(ground);
  const auto all = namedPatches();
  EXPECT_THAT(namesOf(all), ElementsAre("Lawn", "Paving", "xMax", "xMin", "yMax", "yMin", "zMax"));
  EXPECT_NEAR(areaOf(all.at("Lawn")) + areaOf(all.at("Paving")), 12.0 * 9.0, 1e-9);
  EXPECT_NEAR(areaOf(all.at("Lawn")), (border + 5) * 9, rounding);
}

TEST_F(DualMesher, WhatASurfaceLeavesOfADomainSideStaysBare)
{
  TriangleSurface ground;
  addSheet(ground, "Pond", Vec3(-2.2, -1.1, 0), Vec3(3.7, 0, 0), Vec3(0, 2.9, 0));
  mesh(ground);
  const auto all = namedPatches();
  EXPECT_NEAR(areaOf(all.at("Pond")) + areaOf(all.at("zMin")), 12.0 * 9.0, 1e-9);
  EXPECT_NEAR(areaOf(all.at("Pond")), 3.7 * 2.9, rounding);
}

using Place = std::tuple<double, double, double>;

Place placeOf(vtkPolyData* patch, vtkIdType point)
{
  double p[3];
  patch->GetPoint(point, p);
  return {p[0], p[1], p[2]};
}

std::map<Place, vtkIdType> volumePoints(vtkPolyData* patch)
{
  std::map<Place, vtkIdType> ids;
  vtkDataArray* array = patch->GetPointData()->GetArray("VolumePointId");
  for (vtkIdType i = 0; i < patch->GetNumberOfPoints(); ++i)
  {
    ids[placeOf(patch, i)] = static_cast<vtkIdType>(array->GetComponent(i, 0));
  }
  return ids;
}

/// Points of edges that one face has.
std::set<Place> boundaryEdgeOf(vtkPolyData* patch)
{
  std::map<std::pair<vtkIdType, vtkIdType>, int> uses;
  vtkNew<vtkIdList> face;
  for (vtkIdType f = 0; f < patch->GetNumberOfCells(); ++f)
  {
    patch->GetCellPoints(f, face);
    const vtkIdType n = face->GetNumberOfIds();
    for (vtkIdType i = 0; i < n; ++i)
    {
      ++uses[std::minmax(face->GetId(i), face->GetId((i + 1) % n))];
    }
  }
  std::set<Place> boundaryEdge;
  for (const auto& [edge, count] : uses)
  {
    if (count == 1)
    {
      boundaryEdge.insert({placeOf(patch, edge.first), placeOf(patch, edge.second)});
    }
  }
  return boundaryEdge;
}

TEST_F(DualMesher, SheetHasTwoSidesWithPointsOfTheirOwnButForTheBoundaryEdge)
{
  TriangleSurface screen;
  addSheet(screen, "Screen", Vec3(-2.1, 0.3, 1.7), Vec3(4.4, 0, 0), Vec3(0, 0, 2.6));
  mesh(screen);
  EXPECT_NEAR(meshVolume(), volumeOf(domain), 1e-9 * volumeOf(domain));
  const auto all = namedPatches();
  ASSERT_EQ(all.count("Screen_front") + all.count("Screen_back") + all.count("Screen"), 2u);
  vtkPolyData* front = all.at("Screen_front");
  vtkPolyData* back = all.at("Screen_back");
  EXPECT_NEAR(areaOf(front), areaOf(back), 1e-12);
  EXPECT_NEAR(areaOf(front), 4.4 * 2.6, rounding);
  const auto frontPoints = volumePoints(front);
  const auto backPoints = volumePoints(back);
  const std::set<Place> boundaryEdge = boundaryEdgeOf(front);
  ASSERT_EQ(frontPoints.size(), backPoints.size());
  for (const auto& [place, id] : frontPoints)
  {
    ASSERT_EQ(backPoints.count(place), 1u);
    EXPECT_EQ(backPoints.at(place) == id, boundaryEdge.count(place) == 1);
  }
  EXPECT_EQ(front->GetCellData()->GetArray("Side")->GetRange()[1], 0.0);
  EXPECT_EQ(back->GetCellData()->GetArray("Side")->GetRange()[0], 1.0);
}

TEST_F(DualMesher, FrontOfASheetIsWhereItsTrianglesRunCounterClockwise)
{
  TriangleSurface screen;
  addSheet(screen, "Screen", Vec3(-20, -20, 3.1), Vec3(40, 0, 0), Vec3(0, 40, 0)); // front upwards
  mesher->SetZoneRule(vtkAtriaDualMesher::All);
  mesh(screen);
  EXPECT_EQ(messages.takeWarnings(atria::testing::cutAtSides).size(), 1u);
  const auto all = namedPatches();
  const Vec3 s = domain.size();
  for (const char* name : {"Screen_front", "Screen_back"})
  {
    EXPECT_NEAR(areaOf(all.at(name)), s[0] * s[1], 1e-9);
    vtkDataArray* owners = all.at(name)->GetCellData()->GetArray("OwnerCellId");
    double bounds[6];
    volume()->GetCellBounds(static_cast<vtkIdType>(owners->GetComponent(0, 0)), bounds);
    EXPECT_EQ(bounds[4] > 3.1 - 1e-9, std::string(name) == "Screen_front");
  }
}

TEST_F(DualMesher, ASolidThinnerThanTheOctantsIsASheetOfOnePatch)
{
  TriangleSurface slab;
  addBox(slab, "Slab", {Vec3(-2.1, 0.3, 1.7), Vec3(2.3, 0.305, 4.3)});
  mesh(slab);
  const auto all = namedPatches();
  EXPECT_THAT(namesOf(all), ElementsAre("Slab", "xMax", "xMin", "yMax", "yMin", "zMax", "zMin"));
  EXPECT_NEAR(meshVolume(), volumeOf(domain), 1e-9 * volumeOf(domain));
  EXPECT_NEAR(areaOf(all.at("Slab")), 2 * 4.4 * 2.6, 0.05 * 2 * 4.4 * 2.6);
}

TEST_F(DualMesher, RandomSurfacesGiveConformalMeshesThatFillTheDomain)
{
  domain = {atria::Vec3::Constant(-4.3), atria::Vec3::Constant(4.1)};
  atria::testing::setGrid(mesher, domain, 0.3, 0.6, 1.2);
  mesher->SetZoneRule(vtkAtriaDualMesher::All);
  for (unsigned seed = 1; seed <= 15; ++seed)
  {
    SCOPED_TRACE(seed);
    mesh(atria::testing::randomSoup(seed));
    messages.takeWarnings(atria::testing::cutAtSides);
    messages.takeWarnings(atria::testing::endAtSides);
    EXPECT_NEAR(meshVolume() + volumeLeftOut(), volumeOf(domain), 1e-9 * volumeOf(domain));
  }
}

TEST_F(DualMesher, ADomainThatHoldsNothingOfTheModelIsAnError)
{
  TriangleSurface surface;
  addBox(surface, "Building", {Vec3(20, 20, 0), Vec3(30, 30, 9)});
  setSurface(surface);
  mesher->Update();
  EXPECT_THAT(atria::testing::firstOf(messages.takeErrors()),
              ::testing::AllOf(::testing::HasSubstr("holds nothing of the model: it reaches x from -5 to 7"),
                               ::testing::HasSubstr("the model x from 20 to 30")));
  expectEmpty();
}

TEST_F(DualMesher, ADomainThatDoesNotSuitTheModelIsWarnedOfOnceAndInTheDiagnostics)
{
  const auto told = [&] { return atria::testing::fieldStrings(diagnostics(), "InputWarning"); };
  mesh(closedBox());
  EXPECT_THAT(told(), ::testing::IsEmpty());
  TriangleSurface tower;
  addBox(tower, "Tower", {Vec3(-1, -1, 0), Vec3(1, 1, 20)});
  mesh(tower);
  ASSERT_EQ(told().size(), 1u);
  EXPECT_THAT(told()[0], ::testing::HasSubstr("at zMax ('Tower')"));
  EXPECT_EQ(messages.takeWarnings(told()[0]).size(), 1u);
  TriangleSurface flat;
  addBox(flat, "Flat", {Vec3(-1, -1, 0), Vec3(1, 1, 6)});
  mesh(flat);
  ASSERT_EQ(told().size(), 1u);
  EXPECT_THAT(told()[0], ::testing::HasSubstr("without air between: zMax ('Flat')"));
  EXPECT_EQ(messages.takeWarnings(told()[0]).size(), 1u);
  mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
  mesher->SetZoneRule(vtkAtriaDualMesher::All);
  mesher->Update();
  EXPECT_THAT(told(), ::testing::IsEmpty()) << "asked for";
}

TEST_F(DualMesher, PointsThatSinglePrecisionHasRoundedAreWarnedOf)
{
  const auto moved = [](double far, int type) {
    auto data = atria::testing::toPolyData(closedBox());
    vtkNew<vtkPoints> points;
    points->SetDataType(type);
    for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
    {
      const Vec3 p = Vec3(data->GetPoint(i)) + Vec3(far, 0, 0);
      points->InsertNextPoint(p.data());
    }
    data->SetPoints(points);
    return data;
  };
  mesher->SetDomainMode(vtkAtriaDualMesher::Automatic);
  mesher->SetSizeMax(8.0);
  for (const auto& [far, type, isWarned] :
       {std::tuple(1e7, VTK_FLOAT, true), {1e7, VTK_DOUBLE, false}, {100.0, VTK_FLOAT, false}})
  {
    mesher->SetInputDataObject(moved(far, type));
    mesher->Update();
    EXPECT_EQ(messages.takeWarnings("single precision").size(), isWarned ? 1u : 0u) << far;
    EXPECT_EQ(atria::testing::fieldStrings(diagnostics(), "InputWarning").size(), isWarned ? 1u : 0u);
  }
}

TEST_F(DualMesher, SurfacesThatGotNoFaceAreListed)
{
  TriangleSurface surface = closedBox();
  addSheet(surface, "Crumb", Vec3(5.03, 3.03, 5.03), Vec3(0.02, 0, 0), Vec3(0, 0.02, 0));
  addSheet(surface, "Beyond", Vec3(20, 20, 20), Vec3(1, 0, 0), Vec3(0, 1, 0));
  mesh(surface);
  EXPECT_THAT(atria::testing::fieldStrings(diagnostics(), "SurfaceWithoutFaces"), ElementsAre("Crumb", "Beyond"));
}

TEST_F(DualMesher, MergedSheetsAreReportedWhereTheyAre)
{
  TriangleSurface sheets;
  addSheet(sheets, "A", Vec3(-20, -20, 3.1), Vec3(40, 0, 0), Vec3(0, 40, 0));
  addSheet(sheets, "B", Vec3(-20, -20, 3.2), Vec3(40, 0, 0), Vec3(0, 40, 0));
  mesh(sheets);
  EXPECT_EQ(messages.takeWarnings(atria::testing::cutAtSides).size(), 1u);
  ASSERT_GT(diagnostics()->GetNumberOfCells(), 0);
  EXPECT_THAT(atria::testing::fieldStrings(diagnostics(), "DiagnosticName"), ::testing::Contains("MergedSheets"));
  double bounds[6];
  diagnostics()->GetBounds(bounds);
  EXPECT_NEAR(bounds[4], 3.1, 1e-6);
  EXPECT_NEAR(bounds[5], 3.2, 1e-6);
  const double* cells = diagnostics()->GetCellData()->GetArray("CellId")->GetRange();
  EXPECT_GE(cells[0], 0.0);
  EXPECT_LT(cells[1], volume()->GetNumberOfCells());
}

} // namespace
