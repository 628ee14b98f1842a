// SPDX-License-Identifier: GPL-3.0-or-later
#include "DualMesherTest.h"
#include "SmpThreads.h"
#include "Support/Buildings.h"
#include "Support/ProgressWatch.h"
#include "Support/SampleGrid.h"
#include "vtkAtriaMeshOptimizer.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <gmock/gmock.h>

#include <array>
#include <sstream>

namespace {

using atria::Vec3;
using atria::testing::beyond;
using atria::testing::ProgressWatch;
using atria::testing::toGrid;
using ::testing::HasSubstr;

class MeshOptimizer : public atria::testing::VtkTest
{
protected:
  /// Of all cell types, tangled.
  MeshOptimizer() : mesh(toGrid(atria::testing::mixedCells({6, 5, 6}, 7, 0.6))) { filter->SetInputData(mesh); }

  vtkUnstructuredGrid* run()
  {
    filter->Update();
    return filter->GetOutput();
  }

  vtkSmartPointer<vtkUnstructuredGrid> mesh;
  vtkNew<vtkAtriaMeshOptimizer> filter;
};

/// The worst of each metric that is never to get worse, so that more is worse; and the number of invalid cells.
std::map<std::string, double> worstOf(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches = nullptr)
{
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputData(mesh);
  if (patches)
  {
    quality->SetPatchesData(patches);
  }
  quality->Update();
  std::map<std::string, double> worst{{"invalid", static_cast<double>(quality->GetNumberOfInvalidCells())}};
  vtkTable* summary = quality->GetSummary();
  for (vtkIdType row = 0; row < summary->GetNumberOfRows(); ++row)
  {
    const std::string name = summary->GetValueByName(row, "Metric").ToString();
    if (name == "CellSquish" || name == "FaceSquish" || name == "NonOrthogonality" || name == "Skewness" ||
        name == "AspectRatio")
    {
      worst[name] = summary->GetValueByName(row, "Maximum").ToDouble();
    }
    else if (name == "OrthogonalQuality" || name == "FacePyramids" || name == "ScaledJacobian" || name == "Volume")
    {
      worst[name] = -summary->GetValueByName(row, "Minimum").ToDouble();
    }
  }
  return worst;
}

void expectNoneWorse(const std::map<std::string, double>& before, const std::map<std::string, double>& after)
{
  ASSERT_EQ(before.size(), 10u);
  for (const auto& [name, value] : before)
  {
    EXPECT_LE(after.at(name), value + 1e-9 * std::max(1.0, std::abs(value))) << name;
  }
}

TEST_F(MeshOptimizer, MendsATangledMeshAndMakesNoMetricWorse)
{
  const auto before = worstOf(mesh);
  ASSERT_GT(before.at("invalid"), 20.0);
  const auto after = worstOf(run());
  expectNoneWorse(before, after);
  EXPECT_EQ(after.at("invalid"), 0.0);
  EXPECT_GT(filter->GetNumberOfPoorCellsBefore(), 20);
  EXPECT_LT(filter->GetNumberOfPoorCells(), filter->GetNumberOfPoorCellsBefore() / 10);
}

TEST_F(MeshOptimizer, PassesAllDataAndLeavesItsInputAlone)
{
  vtkNew<vtkDoubleArray> heights;
  heights->SetName("Height");
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    heights->InsertNextValue(mesh->GetPoint(i)[2]);
  }
  mesh->GetPointData()->AddArray(heights);
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("Number");
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    numbers->InsertNextValue(static_cast<double>(i));
  }
  mesh->GetCellData()->AddArray(numbers);
  vtkNew<vtkStringArray> name;
  name->SetName("Project");
  name->InsertNextValue("school");
  mesh->GetFieldData()->AddArray(name);
  vtkNew<vtkUnstructuredGrid> copy;
  copy->DeepCopy(mesh);
  vtkUnstructuredGrid* out = run();
  EXPECT_TRUE(atria::testing::identical(mesh, copy));
  vtkIdType moved = 0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    moved += Vec3(out->GetPoint(i)) != Vec3(mesh->GetPoint(i)) ? 1 : 0;
  }
  EXPECT_EQ(moved, filter->GetNumberOfMovedPoints());
  EXPECT_GT(moved, 0);
  // But for the points and what tells of them all is the same.
  vtkNew<vtkUnstructuredGrid> back;
  back->ShallowCopy(out);
  back->SetPoints(mesh->GetPoints());
  back->GetPointData()->RemoveArray("Displacement");
  back->GetCellData()->RemoveArray("TargetShare");
  for (const char* count : {"MovedPoints", "PoorCellsBefore", "PoorCells"})
  {
    back->GetFieldData()->RemoveArray(count);
  }
  EXPECT_TRUE(atria::testing::identical(back, copy));
}

TEST_F(MeshOptimizer, TellsWhatItDidAndWhatIsLeft)
{
  filter->SetTargetScaledJacobian(0.6);
  vtkUnstructuredGrid* out = run();
  const auto count = [&](const char* name) {
    return static_cast<vtkIdType>(out->GetFieldData()->GetArray(name)->GetTuple1(0));
  };
  EXPECT_EQ(count("MovedPoints"), filter->GetNumberOfMovedPoints());
  EXPECT_EQ(count("PoorCellsBefore"), filter->GetNumberOfPoorCellsBefore());
  EXPECT_EQ(count("PoorCells"), filter->GetNumberOfPoorCells());
  vtkDataArray* shares = out->GetCellData()->GetArray("TargetShare");
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputData(out);
  quality->Update();
  vtkCellData* measured = vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0))->GetCellData();
  vtkIdType poor = 0;
  for (vtkIdType c = 0; c < out->GetNumberOfCells(); ++c)
  {
    const double share = shares->GetTuple1(c);
    EXPECT_LE(share, 1.0);
    poor += share < 1.0 ? 1 : 0;
    const double jacobian = measured->GetArray("ScaledJacobian")->GetTuple1(c);
    EXPECT_TRUE(std::isnan(jacobian) || share <= jacobian / 0.6 + 1e-6) << "cell " << c;
    EXPECT_TRUE(share < 1.0 || measured->GetArray("NonOrthogonality")->GetTuple1(c) <= 60.0 + 1e-6) << "cell " << c;
    EXPECT_TRUE(share < 1.0 || measured->GetArray("Skewness")->GetTuple1(c) <= 2.0 + 1e-6) << "cell " << c;
  }
  EXPECT_GT(poor, 0);
  EXPECT_EQ(poor, filter->GetNumberOfPoorCells());
  vtkDataArray* moves = out->GetPointData()->GetArray("Displacement");
  for (vtkIdType p = 0; p < out->GetNumberOfPoints(); ++p)
  {
    EXPECT_EQ(Vec3(moves->GetTuple3(p)), Vec3(out->GetPoint(p)) - Vec3(mesh->GetPoint(p)));
  }
}

TEST_F(MeshOptimizer, TakesPointsInSinglePrecision)
{
  vtkNew<vtkPoints> floats;
  floats->SetDataTypeToFloat();
  floats->DeepCopy(mesh->GetPoints());
  mesh->SetPoints(floats);
  const auto before = worstOf(mesh);
  EXPECT_EQ(run()->GetPoints()->GetDataType(), VTK_DOUBLE);
  expectNoneWorse(before, worstOf(run()));
}

TEST_F(MeshOptimizer, GivesTheSameBitsForAnyNumberOfThreads)
{
  vtkNew<vtkUnstructuredGrid> serial;
  atria::testing::useThreads(1);
  serial->DeepCopy(run());
  for (const int threads : {2, 7})
  {
    atria::testing::useThreads(threads);
    filter->Modified();
    EXPECT_TRUE(atria::testing::identical(run(), serial)) << threads << " threads";
  }
}

TEST_F(MeshOptimizer, FixBoundaryAndFeatureAngleSayWhatMoves)
{
  const auto movedOnTop = [&] {
    run();
    vtkIdType moved = 0;
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      const Vec3 before(mesh->GetPoint(i));
      const Vec3 after(filter->GetOutput()->GetPoint(i));
      EXPECT_EQ(before[2] == 6.0, after[2] == 6.0);
      moved += before[2] == 6.0 && before != after ? 1 : 0;
    }
    return moved;
  };
  std::array<double, 3> top{3.0, 3.0, 6.0};
  const auto middle = mesh->FindPoint(top.data());
  mesh->GetPoints()->SetPoint(middle, 3.8, 3.6, 6.0);
  filter->SetTargetScaledJacobian(0.5);
  EXPECT_GT(movedOnTop(), 0);
  filter->FixBoundaryOn();
  EXPECT_EQ(movedOnTop(), 0);
}

TEST_F(MeshOptimizer, TargetsSayWhatIsGoodEnough)
{
  run();
  const vtkIdType usual = filter->GetNumberOfPoorCellsBefore();
  filter->SetTargetCellSquish(0.3);
  filter->SetTargetNonOrthogonality(30.0);
  filter->SetTargetSkewness(0.5);
  const auto before = worstOf(mesh);
  expectNoneWorse(before, worstOf(run()));
  EXPECT_GT(filter->GetNumberOfPoorCellsBefore(), usual);
}

TEST_F(MeshOptimizer, MovesThePatchesAlong)
{
  // A sheet in the middle of a grid, one of its points moved within it past the next.
  atria::testing::SampleMesh sample = atria::testing::hexahedra({6, 6, 6});
  for (Vec3& p : sample.points)
  {
    p = p == Vec3(3, 3, 3) ? Vec3(4.3, 3.2, 3.0) : p;
  }
  const atria::FaceMesh faces = makeFaceMesh(sample.points, sample.view());
  const auto patches = atria::testing::toPatches(faces, atria::testing::sidesOfBox({6, 6, 6}), [](const Vec3& center) {
    return std::string(center[2] == 3.0 ? "Sheet" : "");
  });
  const auto grid = toGrid(sample);
  filter->SetInputData(grid);
  filter->SetPatchesData(patches);
  vtkUnstructuredGrid* out = run();
  EXPECT_EQ(filter->GetNumberOfPoorCells(), 0);
  EXPECT_GT(filter->GetNumberOfMovedPoints(), 0);
  expectNoneWorse(worstOf(grid, patches), worstOf(out, filter->GetPatches()));
  EXPECT_TRUE(atria::testing::patchesAreTheBoundary(out, filter->GetPatches()));
  const auto before = atria::testing::patchesByName(patches);
  const auto after = atria::testing::patchesByName(filter->GetPatches());
  EXPECT_EQ(atria::testing::namesOf(before), atria::testing::namesOf(after));
  for (const auto& [name, patch] : after)
  {
    vtkDataArray* ids = patch->GetPointData()->GetArray("VolumePointId");
    for (vtkIdType i = 0; i < patch->GetNumberOfPoints(); ++i)
    {
      EXPECT_EQ(Vec3(patch->GetPoint(i)), Vec3(out->GetPoint(static_cast<vtkIdType>(ids->GetTuple1(i)))));
      EXPECT_TRUE(name.rfind("Sheet", 0) != 0 || patch->GetPoint(i)[2] == 3.0);
    }
    EXPECT_NEAR(atria::testing::areaOf(patch), 36.0, 1e-9) << name;
  }
}

TEST_F(MeshOptimizer, AbortLeavesNothing)
{
  const ProgressWatch watch(filter, beyond(0.5));
  EXPECT_EQ(run()->GetNumberOfPoints(), 0);
  EXPECT_EQ(filter->GetPatches()->GetNumberOfPartitionedDataSets(), 0u);
}

TEST_F(MeshOptimizer, PropertiesOutsideOfTheirRangeAreErrors)
{
  filter->SetTargetCellSquish(2.0);
  EXPECT_EQ(run()->GetNumberOfCells(), 0);
  EXPECT_THAT(messages.takeErrors(),
              ::testing::Contains(HasSubstr("TargetCellSquish is 2; it must be a number from 0 to 0.999")));
  filter->SetTargetCellSquish(0.8);
  EXPECT_GT(run()->GetNumberOfCells(), 0);
}

TEST_F(MeshOptimizer, PropertiesArePrinted)
{
  std::ostringstream text;
  filter->Print(text);
  EXPECT_THAT(text.str(), HasSubstr("TargetNonOrthogonality: 60"));
  EXPECT_THAT(text.str(), HasSubstr("FixBoundary: 0"));
}

TEST_F(MeshOptimizer, ErrorNamesWhatIsWrong)
{
  filter->SetInputData(vtkNew<vtkUnstructuredGrid>());
  EXPECT_EQ(run()->GetNumberOfCells(), 0);
  EXPECT_THAT(messages.takeErrors(), ::testing::Contains(HasSubstr("no cells")));
  vtkNew<vtkUnstructuredGrid> flat;
  flat->DeepCopy(mesh);
  const vtkIdType corners[] = {0, 1, 2};
  flat->InsertNextCell(VTK_TRIANGLE, 3, corners);
  filter->SetInputData(flat);
  EXPECT_EQ(run()->GetNumberOfCells(), 0);
  EXPECT_THAT(messages.takeErrors(),
              ::testing::Contains(HasSubstr("cell " + std::to_string(mesh->GetNumberOfCells()) + " (type 5)")));
}

class OptimizedDual : public atria::testing::DualMesherTest
{
};

TEST_F(OptimizedDual, KeepsItsWallsAndGetsNoWorse)
{
  atria::TriangleSurface surface;
  atria::testing::addBox(surface, "Building", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
  atria::testing::addSheet(surface, "Screen", {2.6, -1.9, 0.0}, {0.3, 3.1, 0.0}, {0.0, 0.0, 2.1});
  setSurface(surface);
  mesher->SetNumberOfLayers(2);
  mesher->Update();
  vtkNew<vtkAtriaMeshOptimizer> filter;
  filter->SetInputConnection(0, mesher->GetOutputPort(0));
  filter->SetPatchesConnection(mesher->GetOutputPort(1));
  filter->SetTargetNonOrthogonality(40.0);
  filter->SetTargetCellSquish(0.5);
  // Where a boundary edge's corner has no vertex, its edges bend a little.
  filter->SetFeatureAngle(1.0);
  filter->Update();
  EXPECT_GT(filter->GetNumberOfMovedPoints(), 0);
  EXPECT_LT(filter->GetNumberOfPoorCells(), filter->GetNumberOfPoorCellsBefore());
  EXPECT_TRUE(atria::testing::patchesAreTheBoundary(filter->GetOutput(), filter->GetPatches()));
  expectNoneWorse(worstOf(volume(), patches()), worstOf(filter->GetOutput(), filter->GetPatches()));
  EXPECT_NEAR(atria::testing::totalVolume(filter->GetOutput(), filter->GetPatches()), meshVolume(),
              1e-9 * meshVolume());
  const auto after = atria::testing::patchesByName(filter->GetPatches());
  for (const auto& [name, patch] : namedPatches())
  {
    EXPECT_NEAR(atria::testing::areaOf(after.at(name)), atria::testing::areaOf(patch), 1e-9) << name;
  }
}

class MeshOptimizerOfBuildings : public atria::testing::DualMesherTest
{
};

TEST_F(MeshOptimizerOfBuildings, LeavesPointsOfZonesWhereTheyAre)
{
  atria::TriangleSurface surface;
  atria::testing::addWalls(surface, {-1.7, -1.9, 0}, {1.1, 1.4, 2.6}, {{{{1.0, 0.8, 2.0, 1.8}}, {}, {}, {}}});
  atria::testing::addSheet(surface, "Roof", {-1.7, -1.9, 2.6}, {2.8, 0, 0}, {0, 3.3, 0});
  atria::testing::addBox(surface, "Tree", {Vec3(1.9, -1, 0.5), Vec3(3.1, 1, 2.5)});
  setSurface(surface);
  mesher->SetFindOpenings(true);
  mesher->AddCellZone("Tree");
  vtkNew<vtkAtriaMeshOptimizer> filter;
  filter->SetInputConnection(mesher->GetOutputPort());
  filter->SetTargetCellSquish(0.3); // so that many move
  filter->Update();
  EXPECT_GT(filter->GetNumberOfMovedPoints(), 0);
  vtkPolyData* zone = namedPatches().at("South_opening_1");
  vtkDataArray* points = zone->GetPointData()->GetArray("VolumePointId");
  vtkUnstructuredGrid* improved = filter->GetOutput();
  for (vtkIdType p = 0; p < zone->GetNumberOfPoints(); ++p)
  {
    EXPECT_EQ(Vec3(zone->GetPoint(p)), Vec3(improved->GetPoint(static_cast<vtkIdType>(points->GetTuple1(p)))));
  }
  const auto treeOf = [](vtkUnstructuredGrid* of) {
    vtkNew<vtkAtriaMeshQuality> quality;
    quality->SetInputData(of);
    quality->Update();
    vtkCellData* cells = quality->GetOutput()->GetCellData();
    double volume = 0.0;
    for (vtkIdType cell = 0; cell < of->GetNumberOfCells(); ++cell)
    {
      volume += cells->GetArray("CellZoneId")->GetTuple1(cell) >= 0 ? cells->GetArray("Volume")->GetTuple1(cell) : 0.0;
    }
    return volume;
  };
  EXPECT_NEAR(treeOf(improved), treeOf(volume()), 1e-9);
}

} // namespace
