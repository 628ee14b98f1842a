// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Geometry.h"
#include "Quality/Metrics.h"
#include "Support/CheckMesh.h"
#include "Support/SampleGrid.h"
#include "Support/TestPaths.h"
#include "Support/VtkErrorGuard.h"
#include "VtkFaceMesh.h"
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkIntArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOpenFOAMReader.h>
#include <vtkPartitionedDataSet.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

namespace {

namespace fs = std::filesystem;
using atria::FaceMesh;
using atria::Vec3;
using atria::testing::CheckMeshReport;
using atria::testing::SampleMesh;
using atria::testing::toGrid;
using atria::testing::toPatches;
using ::testing::HasSubstr;

constexpr std::array<int, 3> size{5, 4, 4};

/// A piece of the plane z = 2 that ends inside the box.
std::string sheetAtTwo(const Vec3& centre)
{
  const bool on = std::abs(centre[2] - 2.0) < 1e-9 && centre[0] > 1 && centre[0] < 3 && centre[1] > 1 && centre[1] < 3;
  return on ? "canopy 1" : "";
}

class OpenFOAMWriter : public atria::testing::VtkTest
{
protected:
  /// Both formats write the same mesh, so all is asked of both.
  int write(vtkUnstructuredGrid* volume, vtkPartitionedDataSetCollection* patches, bool binary, const fs::path& folder)
  {
    vtkNew<vtkAtriaOpenFOAMWriter> writer;
    writer->SetInputDataObject(volume);
    if (patches)
    {
      writer->SetPatchesData(patches);
    }
    writer->SetCaseDirectory(folder.c_str());
    writer->SetWriteBinary(binary);
    writer->SetMergeCoplanarFaces(mergeFaces);
    const int written = writer->Write();
    mergedFaces = writer->GetNumberOfMergedFaces();
    return written;
  }

  fs::path folder(const char* name) const { return scratch.path() / name; }

  static std::string textOf(const fs::path& file)
  {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }

  atria::testing::ScratchFolder scratch;
  /// Most tests ask for the faces of the input, one by one.
  bool mergeFaces = false;
  vtkIdType mergedFaces = 0;
};

FaceMesh facesOf(const SampleMesh& mesh) { return makeFaceMesh(mesh.points, mesh.view()); }

atria::QualityMetrics qualityOf(const SampleMesh& sample, const FaceMesh& mesh)
{
  atria::SilentMonitor silent;
  return computeQuality(mesh, sample.view(), {atria::SerialExecutor(), atria::ProgressRange(silent)});
}

/// To the digits that checkMesh prints, but for the last, which it may round the other way.
void expectSameDigits(double ours, double theirs, const char* what)
{
  EXPECT_NEAR(ours, theirs, 1e-10 * std::max(1.0, std::abs(theirs))) << what;
}

void expectSameQuality(const atria::QualityMetrics& ours, const CheckMeshReport& theirs)
{
  const auto greatest = [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); };
  expectSameDigits(greatest(ours.nonOrthogonality), theirs.maxNonOrthogonality, "non-orthogonality");
  double cosines = 0.0;
  for (const double angle : ours.nonOrthogonalityOfFaces)
  {
    cosines += std::cos(angle * std::numbers::pi / 180);
  }
  const double mean = std::acos(cosines / ours.nonOrthogonalityOfFaces.size()) * 180 / std::numbers::pi;
  expectSameDigits(mean, theirs.averageNonOrthogonality, "average non-orthogonality");
  expectSameDigits(greatest(ours.skewness), theirs.maxSkewness, "skewness");
  expectSameDigits(*std::min_element(ours.volume.begin(), ours.volume.end()), theirs.minVolume, "least volume");
  expectSameDigits(greatest(ours.volume), theirs.maxVolume, "greatest volume");
  expectSameDigits(std::accumulate(ours.volume.begin(), ours.volume.end(), 0.0), theirs.totalVolume, "volume");
}

TEST_F(OpenFOAMWriter, CheckMeshFindsAMixedMeshSoundAndAgreesOnItsQuality)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << "checkMesh is not installed";
  }
  const SampleMesh sample = atria::testing::mixedCells(size, 3, 0.12);
  const FaceMesh mesh = facesOf(sample);
  const auto patches = toPatches(mesh, atria::testing::sidesOfBox(size));
  const atria::QualityMetrics ours = qualityOf(sample, mesh);
  ASSERT_EQ(ours.invalidCells, 0u);
  for (const bool binary : {false, true})
  {
    const fs::path target = folder(binary ? "binary" : "ascii");
    ASSERT_EQ(write(toGrid(sample), patches, binary, target), 1);
    const CheckMeshReport report = atria::testing::runCheckMesh(target);
    ASSERT_TRUE(report.completed) << report.log;
    EXPECT_EQ(report.counts.at("cells"), static_cast<long>(mesh.cellCount));
    EXPECT_EQ(report.counts.at("faces"), static_cast<long>(mesh.faceCount()));
    EXPECT_EQ(report.counts.at("internal faces"), static_cast<long>(mesh.internalFaceCount()));
    EXPECT_EQ(report.counts.at("boundary patches"), 6);
    // Random cells next to coplanar triangles are not all convex, and a corner's pyramid has but one
    // neighbour.
    EXPECT_THAT(report.failures, ::testing::Each(::testing::AnyOf(HasSubstr("Concave"), HasSubstr("determinant"))));
    for (const char* type : {"hexahedra", "prisms", "pyramids", "tetrahedra", "polyhedra"})
    {
      EXPECT_GT(report.cellsByType.at(type), 0) << type;
    }
    expectSameQuality(ours, report);
  }
}

TEST_F(OpenFOAMWriter, CheckMeshAgreesOnTheQualityOfDistortedMeshes)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << "checkMesh is not installed";
  }
  for (unsigned seed = 1; seed <= 5; ++seed)
  {
    const SampleMesh sample = atria::testing::mixedCells(size, seed, 0.3);
    const fs::path target = folder(("case" + std::to_string(seed)).c_str());
    ASSERT_EQ(write(toGrid(sample), nullptr, seed % 2 == 0, target), 1);
    const CheckMeshReport report = atria::testing::runCheckMesh(target);
    ASSERT_TRUE(report.completed) << report.log;
    const atria::QualityMetrics ours = qualityOf(sample, facesOf(sample));
    EXPECT_EQ(ours.invalidCells, 0u);
    expectSameQuality(ours, report);
  }
}

TEST_F(OpenFOAMWriter, CheckMeshAgreesOnWhichMeshesAreInvalid)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << "checkMesh is not installed";
  }
  int invalidMeshes = 0;
  for (unsigned seed = 1; seed <= 8; ++seed)
  {
    const SampleMesh sample = atria::testing::mixedCells({3, 3, 3}, seed, 0.75);
    const fs::path target = folder(("case" + std::to_string(seed)).c_str());
    ASSERT_EQ(write(toGrid(sample), nullptr, false, target), 1);
    const CheckMeshReport report = atria::testing::runCheckMesh(target);
    ASSERT_TRUE(report.completed) << report.log;
    const auto invalid = ::testing::AnyOf(HasSubstr("face pyramids"), HasSubstr("negative cell volume"));
    const bool theirs = std::any_of(report.failures.begin(), report.failures.end(),
                                    [&](const std::string& line) { return ::testing::Value(line, invalid); });
    EXPECT_EQ(qualityOf(sample, facesOf(sample)).invalidCells > 0, theirs) << report.log;
    invalidMeshes += theirs ? 1 : 0;
  }
  EXPECT_GT(invalidMeshes, 0);
  EXPECT_LT(invalidMeshes, 8);
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
    const std::string boundary = textOf(target / "constant/polyMesh/boundary");
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
}

TEST_F(OpenFOAMWriter, CubesAreAFlawlessMeshToCheckMeshAndFoamToVTKReadsThem)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << "checkMesh is not installed";
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
    if (atria::testing::haveCheckMesh())
    {
      const CheckMeshReport report = atria::testing::runCheckMesh(target);
      ASSERT_TRUE(report.completed) << report.log;
      EXPECT_EQ(report.counts.at("cell zones"), 2);
    }
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
  atria::SilentMonitor silent;
  const atria::SerialExecutor executor;
  const atria::RunContext context{executor, atria::ProgressRange(silent)};
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
  const auto patches = toPatches(facesOf(boxOfSquares()), [](const Vec3& centre) {
    const bool top = centre[2] > 0.9;
    return std::string(centre[2] < 0.1 ? "ground" : top && centre[0] < 1 ? "left" : top ? "right" : "");
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
    const std::string boundary = textOf(target / "constant/polyMesh/boundary");
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
}

TEST_F(OpenFOAMWriter, ACellWhoseSidesAreMergedIsConvexToCheckMesh)
{
  if (!atria::testing::haveCheckMesh())
  {
    GTEST_SKIP() << "checkMesh is not installed";
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
    vtkNew<vtkOpenFOAMReader> reader;
    reader->SetFileName((target / (target.filename().string() + ".foam")).c_str());
    reader->SetUse64BitLabels(false);
    reader->UpdateInformation();
    reader->EnableAllPatchArrays();
    reader->DecomposePolyhedraOff();
    reader->Update();
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
      facesOf(sample), [](const Vec3& centre) { return centre[2] < 1e-9 ? std::string("ground") : std::string(); });
  ASSERT_EQ(write(toGrid(sample), patches, false, folder("case")), 1);
  const std::string boundary = textOf(folder("case") / "constant/polyMesh/boundary");
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
  const std::string points = textOf(folder("case") / "constant/polyMesh/points");
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
  EXPECT_EQ(textOf(folder("case") / "system/controlDict"), "mine");
  EXPECT_TRUE(fs::exists(folder("case") / "system/fvSchemes"));
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
    return textOf(folder("case") / "constant/polyMesh/points");
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

} // namespace
