// SPDX-License-Identifier: GPL-3.0-or-later
#include "OpenFOAMWriterTest.h"
#include "Quality/Checks/Metrics.h"
#include "Quality/Faces/Geometry.h"
#include "Support/CheckMesh.h"
#include "Support/FoamReader.h"
#include "Support/QuietContext.h"
#include "Support/SampleGrid.h"
#include "VtkFaceMesh.h"
#include "vtkAtriaOpenFOAMCaseWriter.h"
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using atria::FaceMesh;
using atria::Vec3;
using atria::testing::bytesOf;
using atria::testing::CheckMeshReport;
using atria::testing::facesOf;
using atria::testing::OpenFOAMWriter;
using atria::testing::SampleMesh;
using atria::testing::toGrid;
using atria::testing::toPatches;
using ::testing::HasSubstr;

constexpr std::array<int, 3> size{5, 4, 4};

/// A piece of the plane z = 2 that ends inside the box.
std::string sheetAtTwo(const Vec3& center)
{
  const bool on = std::abs(center[2] - 2.0) < 1e-9 && center[0] > 1 && center[0] < 3 && center[1] > 1 && center[1] < 3;
  return on ? "canopy 1" : "";
}

TEST_F(OpenFOAMWriter, SidesOfASheetAreTwoWallsOfOneGroup)
{
  const SampleMesh sample = atria::testing::hexahedra(size);
  const FaceMesh mesh = facesOf(sample);
  const auto patches = toPatches(mesh, atria::testing::sidesOfBox(size), sheetAtTwo);
  for (const bool binary : {false, true})
  {
    const fs::path target = folder(binary ? "binary" : "ascii");
    ASSERT_EQ(write(toGrid(sample), patches, binary, target), 1);
    const std::string boundary = bytesOf(target / "constant/polyMesh/boundary");
    EXPECT_THAT(boundary, HasSubstr("// \"canopy 1_front\"\n    canopy_1_front\n"));
    EXPECT_THAT(boundary, HasSubstr("inGroups        2(wall canopy_1);"));
    if (atria::testing::haveCheckMesh())
    {
      const CheckMeshReport report = atria::testing::runCheckMesh(target);
      ASSERT_TRUE(report.completed) << report.log;
      EXPECT_EQ(report.failedChecks, 0) << report.log;
      EXPECT_EQ(report.counts.at("boundary patches"), 8);
      EXPECT_EQ(report.counts.at("internal faces"), static_cast<long>(mesh.internalFaceCount()) - 4);
    }
  }
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
}

TEST_F(OpenFOAMWriter, CubesAreAFlawlessMeshToCheckMeshAndFoamToVTKReadsThem)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
  const SampleMesh sample = atria::testing::hexahedra(size);
  const auto patches = toPatches(facesOf(sample), atria::testing::sidesOfBox(size));
  for (const bool binary : {false, true})
  {
    const fs::path target = folder(binary ? "binary" : "ascii");
    ASSERT_EQ(write(toGrid(sample), patches, binary, target), 1);
    const CheckMeshReport report = atria::testing::runCheckMesh(target);
    EXPECT_TRUE(report.completed && report.failedChecks == 0) << report.log;
    EXPECT_EQ(report.maxNonOrthogonality, 0.0);
    std::string log;
    EXPECT_TRUE(atria::testing::runOpenFOAM("foamToVTK", target, log)) << log;
    EXPECT_TRUE(fs::exists(target / "VTK")) << log;
  }
}

TEST_F(OpenFOAMWriter, ZonesBecomeCellZones)
{
  const SampleMesh sample = atria::testing::hexahedra({2, 2, 2});
  const auto grid = toGrid(sample);
  vtkNew<vtkIntArray> zones;
  zones->SetName("ZoneId");
  for (const int id : {0, 0, 0, 7, 7, 7, 7, 7})
  {
    zones->InsertNextValue(id);
  }
  grid->GetCellData()->AddArray(zones);
  for (const bool binary : {false, true})
  {
    const fs::path target = folder(binary ? "binary" : "ascii");
    ASSERT_EQ(write(grid, nullptr, binary, target), 1);
    if (!atria::testing::haveCheckMesh())
    {
      GTEST_SKIP() << atria::testing::withoutCheckMesh;
    }
    const CheckMeshReport report = atria::testing::runCheckMesh(target);
    ASSERT_TRUE(report.completed) << report.log;
    EXPECT_EQ(report.counts.at("cell zones"), 2);
  }
}

TEST_F(OpenFOAMWriter, OneZoneAloneIsNotWritten)
{
  const auto grid = toGrid(atria::testing::hexahedra({2, 1, 1}));
  vtkNew<vtkIntArray> zones;
  zones->SetName("ZoneId");
  zones->InsertNextValue(4);
  zones->InsertNextValue(4);
  grid->GetCellData()->AddArray(zones);
  ASSERT_EQ(write(grid, nullptr, false, folder("case")), 1);
  EXPECT_FALSE(fs::exists(folder("case") / "constant/polyMesh/cellZones"));
}

/// The patches by name, and the internal mesh as "internalMesh".
std::map<std::string, vtkDataSet*> blocksOf(vtkMultiBlockDataSet* data)
{
  std::map<std::string, vtkDataSet*> blocks;
  for (unsigned int i = 0; i < data->GetNumberOfBlocks(); ++i)
  {
    if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(data->GetBlock(i)))
    {
      blocks.merge(blocksOf(inner));
    }
    else if (auto* leaf = vtkDataSet::SafeDownCast(data->GetBlock(i)))
    {
      blocks[data->GetMetaData(i)->Get(vtkCompositeDataSet::NAME())] = leaf;
    }
  }
  return blocks;
}

/// VTK's reader keeps the order of cells, but may begin a cell at another corner.
void expectSameCells(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
{
  const atria::VtkFaceMesh meshes[]{atria::faceMeshFromVtk(a, nullptr), atria::faceMeshFromVtk(b, nullptr)};
  const atria::RunContext context = atria::testing::quietContext();
  const atria::QualityMetrics qa = computeQuality(meshes[0].mesh, meshes[0].cells.view(), context);
  const atria::QualityMetrics qb = computeQuality(meshes[1].mesh, meshes[1].cells.view(), context);
  EXPECT_EQ(qa.invalidCells, 0u);
  ASSERT_EQ(qa.volume.size(), qb.volume.size());
  for (std::size_t c = 0; c < qa.volume.size(); ++c)
  {
    EXPECT_NEAR(qa.volume[c], qb.volume[c], 1e-6) << "cell " << c; // the reader keeps points in single precision
  }
}

/// One cell, a box 2 x 1 x 1 whose faces are unit squares.
SampleMesh boxOfSquares()
{
  SampleMesh box;
  box.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0},
                {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 1}};
  box.addPolyhedron({{0, 6, 9, 3},
                     {2, 5, 11, 8},
                     {0, 1, 7, 6},
                     {1, 2, 8, 7},
                     {3, 9, 10, 4},
                     {4, 10, 11, 5},
                     {0, 3, 4, 1},
                     {1, 4, 5, 2},
                     {6, 7, 10, 9},
                     {7, 8, 11, 10}});
  return box;
}

TEST_F(OpenFOAMWriter, MergesCoplanarFacesOfACellPatchByPatch)
{
  // All of the bottom is one patch, the two halves of the top are one each, the rest is none.
  const auto patches = toPatches(facesOf(boxOfSquares()), [](const Vec3& center) {
    const bool top = center[2] > 0.9;
    return std::string(center[2] < 0.1 ? "ground" : top && center[0] < 1 ? "left" : top ? "right" : "");
  });
  EXPECT_TRUE(vtkNew<vtkAtriaOpenFOAMWriter>()->GetMergeCoplanarFaces());
  const auto patchOfOneFace = [](const char* name, const char* type) {
    return std::string(name) + "\n    {\n        type            " + type + ";\n        nFaces          1;";
  };
  for (const bool binary : {false, true})
  {
    mergeFaces = true;
    const fs::path target = folder(binary ? "binary" : "ascii");
    ASSERT_EQ(write(toGrid(boxOfSquares()), patches, binary, target), 1);
    EXPECT_EQ(mergedFaces, 3) << "front, back and bottom";
    const std::string boundary = bytesOf(target / "constant/polyMesh/boundary");
    for (const char* name : {"ground", "left", "right"})
    {
      EXPECT_THAT(boundary, HasSubstr(patchOfOneFace(name, "wall")));
    }
    EXPECT_THAT(boundary, HasSubstr("defaultFaces\n    {\n        type            patch;\n        nFaces          4;"));
    if (atria::testing::haveCheckMesh())
    {
      const CheckMeshReport report = atria::testing::runCheckMesh(target);
      ASSERT_TRUE(report.completed) << report.log;
      EXPECT_EQ(report.counts.at("points"), 12);
      EXPECT_EQ(report.counts.at("faces"), 7);
    }
  }
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
}

TEST_F(OpenFOAMWriter, MergesOrCutsCellsWithTooFewNeighborsAndKeepsPatchesAndZones)
{
  // Pyramids and tetrahedra in the corners have one neighbor. Two zones, so that cells of both get other numbers.
  vtkIdType merged = 0;
  vtkIdType added = 0;
  for (const unsigned seed : {3U, 34U})
  {
    SCOPED_TRACE(seed);
    const SampleMesh sample = atria::testing::mixedCells(size, seed, 0.12);
    const auto grid = toGrid(sample);
    vtkNew<vtkIntArray> zones;
    zones->SetName("ZoneId");
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      zones->InsertNextValue(cell < grid->GetNumberOfCells() / 2 ? 0 : 1);
    }
    grid->GetCellData()->AddArray(zones);
    const auto patches = toPatches(facesOf(sample), atria::testing::sidesOfBox(size));
    EXPECT_TRUE(vtkNew<vtkAtriaOpenFOAMWriter>()->GetMergeUnderdeterminedCells());
    std::string boundary[2];
    for (const bool merge : {false, true})
    {
      mergeCells = merge;
      const fs::path target = folder((merge ? "merged" : "plain") + std::to_string(seed));
      ASSERT_EQ(write(grid, patches, false, target), 1);
      EXPECT_EQ(mergedCells + addedCells > 0, merge);
      merged += mergedCells;
      added += addedCells;
      std::istringstream lines(bytesOf(target / "constant/polyMesh/boundary"));
      for (std::string line; std::getline(lines, line);)
      {
        boundary[merge ? 1 : 0] += line.find("startFace") == std::string::npos ? line + "\n" : "";
      }
      if (!atria::testing::haveCheckMesh())
      {
        continue;
      }
      const CheckMeshReport report = atria::testing::runCheckMesh(target);
      ASSERT_TRUE(report.completed) << report.log;
      EXPECT_EQ(report.counts.at("cells"), grid->GetNumberOfCells() - mergedCells + addedCells);
      EXPECT_EQ(report.counts.at("cell zones"), 2);
      EXPECT_EQ(report.log.find("small determinant") == std::string::npos, merge) << report.log;
      EXPECT_THAT(report.failures, ::testing::Each(::testing::AnyOf(HasSubstr("Concave"), HasSubstr("determinant"))));
    }
    EXPECT_EQ(boundary[0], boundary[1]);
  }
  EXPECT_GT(merged, 0);
  EXPECT_GT(added, 0);
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
}

TEST_F(OpenFOAMWriter, ACellWhoseSidesAreMergedIsConvexToCheckMesh)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << atria::testing::withoutCheckMesh;
  }
  for (const bool merge : {false, true})
  {
    mergeFaces = merge;
    ASSERT_EQ(write(toGrid(boxOfSquares()), nullptr, false, folder("case")), 1);
    EXPECT_EQ(mergedFaces, merge ? 4 : 0);
    const CheckMeshReport report = atria::testing::runCheckMesh(folder("case"));
    ASSERT_TRUE(report.completed) << report.log;
    EXPECT_EQ(report.log.find("Concave cells") == std::string::npos, merge) << report.log;
    EXPECT_EQ(report.log.find("Error in face tets"), std::string::npos) << report.log;
  }
}

TEST_F(OpenFOAMWriter, VtkReadsTheSameMeshBack)
{
  const SampleMesh sample = atria::testing::mixedCells(size, 8, 0.1);
  const FaceMesh mesh = facesOf(sample);
  const auto grid = toGrid(sample);
  const auto patches = toPatches(mesh, atria::testing::sidesOfBox(size));
  for (const bool binary : {false, true})
  {
    const fs::path target = folder(binary ? "binary" : "ascii");
    ASSERT_EQ(write(grid, patches, binary, target), 1);
    const auto reader = atria::testing::readFoam(target / (target.filename().string() + ".foam"));
    const auto blocks = blocksOf(reader->GetOutput());
    for (const char* name : atria::sideNames)
    {
      ASSERT_EQ(blocks.count(name), 1u) << name;
      EXPECT_GE(blocks.at(name)->GetNumberOfCells(), 16);
    }
    ASSERT_EQ(blocks.count("internalMesh"), 1u);
    auto* readBack = vtkUnstructuredGrid::SafeDownCast(blocks.at("internalMesh"));
    ASSERT_EQ(readBack->GetNumberOfCells(), grid->GetNumberOfCells());
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      EXPECT_EQ(readBack->GetCell(c)->GetNumberOfPoints(), grid->GetCell(c)->GetNumberOfPoints());
      EXPECT_EQ(readBack->GetCell(c)->GetNumberOfFaces(), grid->GetCell(c)->GetNumberOfFaces());
    }
    expectSameCells(readBack, grid);
  }
}

TEST_F(OpenFOAMWriter, FacesInNoPatchGoToDefaultFaces)
{
  const SampleMesh sample = atria::testing::hexahedra({2, 2, 2});
  const auto patches = toPatches(
      facesOf(sample), [](const Vec3& center) { return center[2] < 1e-9 ? std::string("ground") : std::string(); });
  ASSERT_EQ(write(toGrid(sample), patches, false, folder("case")), 1);
  const std::string boundary = bytesOf(folder("case") / "constant/polyMesh/boundary");
  EXPECT_THAT(boundary, HasSubstr("ground\n    {\n        type            wall;\n        nFaces          4;"));
  EXPECT_THAT(boundary, HasSubstr("defaultFaces\n    {\n        type            patch;\n        nFaces          20;"));
}

TEST_F(OpenFOAMWriter, PointsThatNoCellHasAreLeftOut)
{
  SampleMesh sample = atria::testing::hexahedra({1, 1, 1});
  sample.points.insert(sample.points.begin() + 3, Vec3(9, 9, 9));
  for (std::int64_t& id : sample.connectivity)
  {
    id += id >= 3 ? 1 : 0;
  }
  ASSERT_EQ(write(toGrid(sample), nullptr, false, folder("case")), 1);
  const std::string points = bytesOf(folder("case") / "constant/polyMesh/points");
  EXPECT_THAT(points, HasSubstr("\n8\n("));
  EXPECT_THAT(points, ::testing::Not(HasSubstr("9 9 9")));
}

TEST_F(OpenFOAMWriter, ReplacesAnEarlierMeshButNoSettings)
{
  const fs::path mesh = folder("case") / "constant/polyMesh";
  fs::create_directories(mesh);
  fs::create_directories(folder("case") / "system");
  std::ofstream(mesh / "points.gz") << "stale";
  std::ofstream(mesh / "cellZones") << "stale";
  std::ofstream(folder("case") / "system/controlDict") << "mine";
  ASSERT_EQ(write(toGrid(atria::testing::hexahedra({1, 1, 1})), nullptr, false, folder("case")), 1);
  EXPECT_FALSE(fs::exists(mesh / "points.gz"));
  EXPECT_FALSE(fs::exists(mesh / "cellZones"));
  EXPECT_EQ(bytesOf(folder("case") / "system/controlDict"), "mine");
  EXPECT_TRUE(fs::exists(folder("case") / "system/fvSchemes"));
}

TEST_F(OpenFOAMWriter, WarnsOfResultsWithAnEarlierMeshAndKeepsThem)
{
  for (const char* result : {"100", "0.5", "postProcessing", "wind_270/200", "processor1/5", "wind_90/processor0/1e-3"})
  {
    const fs::path inCase = folder("case") / result;
    fs::create_directories(inCase);
    fs::create_directories(folder("case") / "0");
    fs::create_directories(folder("case") / "mine/7");
    EXPECT_EQ(write(toGrid(atria::testing::hexahedra({1, 1, 1})), nullptr, false, folder("case")), 1);
    EXPECT_EQ(messages.takeWarnings(std::string("an earlier mesh (") + result + ")").size(), 1u) << result;
    EXPECT_TRUE(fs::exists(inCase));
    fs::remove_all(folder("case"));
  }
}

TEST_F(OpenFOAMWriter, PutsTheMeshBackWhereTheModelWasIfAsked)
{
  const auto grid = toGrid(atria::testing::hexahedra({1, 1, 1}));
  vtkNew<vtkDoubleArray> offset;
  offset->SetName("ModelOffset");
  offset->SetNumberOfComponents(3);
  offset->InsertNextTuple3(92300.0, 437000.0, -7.0);
  grid->GetFieldData()->AddArray(offset);
  const auto pointsOf = [&](bool restore) {
    vtkNew<vtkAtriaOpenFOAMWriter> writer;
    writer->SetInputDataObject(grid);
    writer->SetCaseDirectory(folder("case").c_str());
    writer->SetRestoreOffset(restore);
    EXPECT_EQ(writer->Write(), 1);
    expectWarnings(writer, true);
    return bytesOf(folder("case") / "constant/polyMesh/points");
  };
  EXPECT_THAT(pointsOf(true), HasSubstr("(92301 437001 -6)"));
  EXPECT_THAT(pointsOf(false), HasSubstr("(1 1 1)"));
}

TEST_F(OpenFOAMWriter, LeavesItsInputAsItWas)
{
  const auto grid = toGrid(atria::testing::hexahedra({2, 1, 1}));
  const vtkMTimeType before = grid->GetMTime();
  ASSERT_EQ(write(grid, nullptr, false, folder("case")), 1);
  EXPECT_EQ(grid->GetMTime(), before);
}

class OpenFOAMWriterError : public OpenFOAMWriter
{
protected:
  void expectError(const std::string& text)
  {
    EXPECT_THAT(messages.takeErrors(), ::testing::ElementsAre(HasSubstr(text)));
  }
};

TEST_F(OpenFOAMWriterError, MeshWithoutCells)
{
  EXPECT_EQ(write(vtkNew<vtkUnstructuredGrid>(), nullptr, false, folder("case")), 0);
  expectError("has no cells");
}

TEST_F(OpenFOAMWriterError, NoFolderGiven)
{
  EXPECT_EQ(write(toGrid(atria::testing::hexahedra({1, 1, 1})), nullptr, false, ""), 0);
  expectError("No CaseDirectory");
}

TEST_F(OpenFOAMWriterError, FolderThatCannotBeMade)
{
  std::ofstream(folder("file")) << "in the way";
  EXPECT_EQ(write(toGrid(atria::testing::hexahedra({1, 1, 1})), nullptr, false, folder("file")), 0);
  expectError("cannot make the folder");
}

TEST_F(OpenFOAMWriterError, PatchFaceThatIsNoFaceOfItsOwner)
{
  const SampleMesh sample = atria::testing::hexahedra({2, 2, 2});
  const auto patches = toPatches(facesOf(sample), atria::testing::sidesOfBox({2, 2, 2}));
  auto* part = vtkPolyData::SafeDownCast(patches->GetPartitionedDataSet(2)->GetPartitionAsDataObject(0));
  vtkIdTypeArray::SafeDownCast(part->GetCellData()->GetArray("OwnerCellId"))->SetValue(1, 7);
  EXPECT_EQ(write(toGrid(sample), patches, false, folder("case")), 0);
  expectError("face 1 of patch 'yMax' is no face of its owner, cell 7");
}

TEST_F(OpenFOAMWriterError, FaceInTwoPatches)
{
  const SampleMesh sample = atria::testing::hexahedra({1, 1, 1});
  const auto patches = toPatches(facesOf(sample), atria::testing::sidesOfBox({1, 1, 1}));
  patches->SetPartition(1, 0, patches->GetPartition(0, 0));
  EXPECT_EQ(write(toGrid(sample), patches, false, folder("case")), 0);
  expectError("face 0 of patch 'xMin' is already face 0 of patch 'xMax'");
}

TEST_F(OpenFOAMWriterError, PatchWithoutItsArrays)
{
  const SampleMesh sample = atria::testing::hexahedra({1, 1, 1});
  const auto patches = toPatches(facesOf(sample), atria::testing::sidesOfBox({1, 1, 1}));
  auto* part = vtkPolyData::SafeDownCast(patches->GetPartitionedDataSet(0)->GetPartitionAsDataObject(0));
  part->GetPointData()->RemoveArray("VolumePointId");
  EXPECT_EQ(write(toGrid(sample), patches, false, folder("case")), 0);
  expectError("VolumePointId");
}

TEST(OpenFOAMCaseWriter, ListsOfRulesAreEmptyBeyondTheirEnds)
{
  vtkNew<vtkAtriaOpenFOAMCaseWriter> writer;
  writer->AddPatchRule("Glass* slip");
  writer->AddPatchRule(nullptr);
  EXPECT_EQ(writer->GetNumberOfPatchRules(), 2);
  EXPECT_EQ(writer->GetPatchRule(0), "Glass* slip");
  EXPECT_EQ(writer->GetPatchRule(1), "");
  EXPECT_EQ(writer->GetPatchRule(2), "");
  EXPECT_EQ(writer->GetPatchRule(-1), "");
  EXPECT_EQ(writer->GetWindAngle(0), 0.0);
  const vtkMTimeType before = writer->GetMTime();
  writer->RemoveAllPatchRules();
  EXPECT_EQ(writer->GetNumberOfPatchRules(), 0);
  EXPECT_GT(writer->GetMTime(), before);
}

} // namespace
