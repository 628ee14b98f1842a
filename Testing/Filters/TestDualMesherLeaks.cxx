// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones, leaks and closed cracks as the mesher's third output tells them.
#include "DualMesherTest.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkPoints.h>
#include <vtkStringArray.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

namespace {

using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::addBox;
using atria::testing::addSheet;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class DualMesherLeaks : public atria::testing::DualMesherTest
{
protected:
  std::vector<vtkIdType> cellsOfKind(const std::string& name)
  {
    const auto names = atria::testing::fieldStrings(diagnostics(), "DiagnosticName");
    std::vector<vtkIdType> cells;
    for (vtkIdType i = 0; i < diagnostics()->GetNumberOfCells(); ++i)
    {
      const auto kind = static_cast<std::size_t>(diagnostics()->GetCellData()->GetArray("Diagnostic")->GetTuple1(i));
      if (names.at(kind) == name)
      {
        cells.push_back(i);
      }
    }
    return cells;
  }
  double width(vtkIdType cell) { return diagnostics()->GetCellData()->GetArray("Width")->GetTuple1(cell); }
  vtkDataArray* field(const char* name) { return diagnostics()->GetFieldData()->GetArray(name); }
};

/// A room over the ground whose door stops 0.7 above it.
TriangleSurface roomWithGapBelowItsDoor()
{
  TriangleSurface surface;
  const Vec3 x(4, 0, 0), y(0, 4, 0), z(0, 0, 3);
  const Vec3 corner(-2.1, -1.9, 0);
  addSheet(surface, "Ground", Vec3(-9, -9, 0), Vec3(18, 0, 0), Vec3(0, 18, 0));
  addSheet(surface, "West", corner, y, z);
  addSheet(surface, "South", corner, x, z);
  addSheet(surface, "North", corner + y, x, z);
  addSheet(surface, "Roof", corner + z, x, y);
  addSheet(surface, "Door", corner + x + Vec3(0, 0, 0.7), y, z - Vec3(0, 0, 0.7));
  return surface;
}

TEST_F(DualMesherLeaks, ALeakIsALineFromTheSealedSeedToTheOutsideAndNamesItsNarrowestPlace)
{
  setSurface(roomWithGapBelowItsDoor());
  mesher->AddSealedSeed(0, 0, 1.5);
  mesher->Update();
  const auto cells = cellsOfKind("LeakPath");
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_NEAR(width(cells[0]), 0.7, 0.01);
  vtkNew<vtkIdList> ids;
  diagnostics()->GetCellPoints(cells[0], ids);
  ASSERT_GT(ids->GetNumberOfIds(), 5);
  const Vec3 first(diagnostics()->GetPoint(ids->GetId(0)));
  EXPECT_LT((first - Vec3(0, 0, 1.5)).norm(), 1.0);
  const Vec3 last(diagnostics()->GetPoint(ids->GetId(ids->GetNumberOfIds() - 1)));
  const Vec3 toSides = (last - domain.min).cwiseMin(domain.max - last);
  EXPECT_EQ(toSides.minCoeff(), 0.0);
  const Vec3 place(field("LeakPlace")->GetTuple3(0));
  EXPECT_NEAR(place[0], 1.9, 0.01);
  EXPECT_NEAR(place[2], 0.35, 0.01);
  EXPECT_THAT(atria::testing::fieldStrings(diagnostics(), "LeakMessage"),
              ElementsAre(AllOf(HasSubstr("(0, 0, 1.5)"), HasSubstr("Door"), HasSubstr("Ground"))));
  const double* owner = diagnostics()->GetCellData()->GetArray("CellId")->GetRange();
  EXPECT_GE(owner[0], 0);
  EXPECT_LT(owner[1], volume()->GetNumberOfCells());
}

/// Of a plane patch.
double distanceToPlane(const Vec3& place, vtkPolyData* patch)
{
  vtkPoints* points = patch->GetCell(0)->GetPoints();
  const Vec3 a(points->GetPoint(0)), b(points->GetPoint(1)), c(points->GetPoint(2));
  return std::abs((b - a).cross(c - a).normalized().dot(place - a));
}

TEST_F(DualMesherLeaks, ALeakEndsOnTheSideOfThePrismThatItNames)
{
  TriangleSurface surface = roomWithGapBelowItsDoor();
  addSheet(surface, "Sky", Vec3(-20, -20, 6), Vec3(40, 0, 0), Vec3(0, 40, 0)); // no way out
  setSurface(surface);
  mesher->AddSealedSeed(0, 0, 1.5);
  for (const int sides : {4, 5, 8})
  {
    SCOPED_TRACE(sides);
    mesher->SetDomainSides(sides);
    mesher->SetDomainAngle(20.0 + sides);
    mesher->Update();
    const auto side = atria::testing::fieldStrings(diagnostics(), "LeakSide");
    ASSERT_EQ(side.size(), 1u);
    const auto named = namedPatches();
    const auto found = named.find(side[0]);
    ASSERT_NE(found, named.end()) << side[0];
    EXPECT_THAT(atria::testing::fieldStrings(diagnostics(), "LeakMessage")[0],
                HasSubstr("reaches the side " + side[0] + ";"));
    vtkNew<vtkIdList> ids;
    diagnostics()->GetCellPoints(cellsOfKind("LeakPath").at(0), ids);
    const Vec3 last(diagnostics()->GetPoint(ids->GetId(ids->GetNumberOfIds() - 1)));
    EXPECT_LT(distanceToPlane(last, found->second), 1e-3);
  }
  EXPECT_EQ(messages.takeWarnings(atria::testing::cutAtSides).size(), 3u) << "of the sky";
}

TEST_F(DualMesherLeaks, ASealedSeedDoesNotChangeTheMesh)
{
  setSurface(roomWithGapBelowItsDoor());
  mesher->Update();
  const auto before = copiesOfOutputs();
  EXPECT_THAT(cellsOfKind("LeakPath"), IsEmpty());
  mesher->AddSealedSeed(0, 0, 1.5);
  mesher->Update();
  EXPECT_TRUE(atria::testing::identical(before[0], volume()));
  EXPECT_TRUE(atria::testing::identical(before[1], patches()));
}

TEST_F(DualMesherLeaks, ALeakOutsideOfTheMeshHasNoCell)
{
  TriangleSurface surface = roomWithGapBelowItsDoor();
  addBox(surface, "Vault", {Vec3(3.2, 1.2, 2.2), Vec3(5.1, 3.4, 4.1)});
  setSurface(surface);
  mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
  mesher->AddSeed(4, 2, 3);
  mesher->AddSealedSeed(4, 2, 3);
  mesher->AddSealedSeed(0, 0, 1.5);
  mesher->Update();
  const auto cells = cellsOfKind("LeakPath");
  ASSERT_EQ(cells.size(), 1u) << "the vault is closed, the room is not";
  EXPECT_EQ(diagnostics()->GetCellData()->GetArray("CellId")->GetTuple1(cells[0]), -1);
}

TEST_F(DualMesherLeaks, DroppedZonesAreToldWithAPointThatIsASeedOfThem)
{
  TriangleSurface surface;
  addSheet(surface, "Terrain", Vec3(-8, -8, 0.9), Vec3(20, 0, 1.2), Vec3(0, 16, 0.4));
  addBox(surface, "House", {Vec3(-2, -2, 3), Vec3(2, 2, 5)});
  setSurface(surface);
  mesher->Update();
  ASSERT_EQ(field("ZoneElements")->GetNumberOfTuples(), 3);
  const auto elements = volume()->GetNumberOfCells();
  double kept = 0.0;
  std::vector<std::string> dropped;
  for (vtkIdType zone = 0; zone < 3; ++zone)
  {
    if (field("ZoneKept")->GetTuple1(zone) != 0.0)
    {
      kept += field("ZoneElements")->GetTuple1(zone);
      continue;
    }
    dropped.push_back(atria::testing::fieldStrings(diagnostics(), "ZoneSurfaces").at(zone));
    const Vec3 inside(field("ZonePoint")->GetTuple3(zone));
    vtkNew<vtkAtriaDualMesher> other;
    other->SetNumberOfLayers(0);
    other->SetSupportElements(false);
    atria::testing::setGrid(other, domain, 0.5, 1.0, 2.0);
    other->SetInputDataObject(atria::testing::toPolyData(surface));
    other->SetZoneRule(vtkAtriaDualMesher::Seeds);
    other->AddSeed(inside[0], inside[1], inside[2]);
    other->Update();
    auto* mesh = vtkUnstructuredGrid::SafeDownCast(other->GetOutputDataObject(0));
    EXPECT_EQ(mesh->GetNumberOfCells(), field("ZoneElements")->GetTuple1(zone));
    EXPECT_EQ(mesh->GetCellData()->GetArray("ZoneId")->GetRange()[0], zone);
  }
  EXPECT_EQ(kept, elements);
  EXPECT_THAT(dropped, ::testing::UnorderedElementsAre("Terrain", "House"));
  EXPECT_THAT(atria::testing::fieldStrings(diagnostics(), "ZoneKind"),
              ::testing::UnorderedElementsAre("open", "open", "solid"));
  EXPECT_NEAR(field("ZoneVolume")->GetTuple1(2), 4 * 4 * 2, 12);
  EXPECT_EQ(messages.takeWarnings(atria::testing::cutAtSides).size(), 3u) << "of a terrain that is not named as one";
}

TEST_F(DualMesherLeaks, AClosedCrackIsALineAlongIt)
{
  TriangleSurface surface;
  addSheet(surface, "South", Vec3(0.13, -9, -1), Vec3(0, 9.4, 0), Vec3(0, 0, 9));
  addSheet(surface, "North", Vec3(0.13, 0.6, -1), Vec3(0, 9, 0), Vec3(0, 0, 9));
  setSurface(surface);
  mesher->Update();
  EXPECT_EQ(messages.takeWarnings(atria::testing::cutAtSides).size(), 1u);
  const auto cells = cellsOfKind("ClosedCrack");
  ASSERT_EQ(cells.size(), 1u);
  EXPECT_NEAR(width(cells[0]), 0.2, 1e-6);
  double bounds[6];
  diagnostics()->GetCellBounds(cells[0], bounds);
  EXPECT_NEAR(bounds[2], 0.5, 1e-6);
  EXPECT_NEAR(bounds[3], 0.5, 1e-6);
  EXPECT_NEAR(bounds[5] - bounds[4], domain.size()[2], 0.25);
}

TEST_F(DualMesherLeaks, SealedSeedsAreAList)
{
  mesher->SetSealedSeed(1, 4, 5, 6);
  ASSERT_EQ(mesher->GetNumberOfSealedSeeds(), 2);
  double seed[3];
  mesher->GetSealedSeed(1, seed);
  EXPECT_EQ(Vec3(seed), Vec3(4, 5, 6));
  std::ostringstream text;
  mesher->Print(text);
  EXPECT_THAT(text.str(), AllOf(HasSubstr("NumberOfSealedSeeds: 2"), HasSubstr("4 5 6")));
  mesher->RemoveAllSealedSeeds();
  EXPECT_EQ(mesher->GetNumberOfSealedSeeds(), 0);
  mesher->SetSealedSeed(-1, 0, 0, 0);
  mesher->GetSealedSeed(0, seed);
  EXPECT_THAT(messages.takeErrors(), ::testing::Each(HasSubstr("There is no sealed seed")));
}

TEST_F(DualMesherLeaks, ASealedSeedOutsideTheDomainIsAnError)
{
  setSurface(roomWithGapBelowItsDoor());
  mesher->AddSealedSeed(0, 0, 50);
  mesher->Update();
  EXPECT_THAT(messages.takeErrors(),
              ::testing::Contains(AllOf(HasSubstr("sealed seed"), HasSubstr("50"), HasSubstr("domain"))));
  expectEmpty();
}

} // namespace
