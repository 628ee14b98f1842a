// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesher's outputs and the polyMesh written from them are the same mesh, to VTK's reader and to checkMesh.
#include "DualMesherTest.h"
#include "Quality/Faces/Geometry.h"
#include "Support/CheckMesh.h"
#include "Support/CheckWarnings.h"
#include "Support/FoamReader.h"
#include "Support/QuietContext.h"
#include "Support/TestPaths.h"
#include "VtkFaceMesh.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkCellType.h>
#include <vtkCompositeDataSet.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace {

namespace fs = std::filesystem;
using atria::Index;
using atria::testing::CheckMeshReport;
using ::testing::AnyOf;
using ::testing::Each;
using ::testing::HasSubstr;

/// The patches by name, and the internal mesh as "internalMesh".
void collectBlocks(vtkMultiBlockDataSet* data, std::map<std::string, vtkDataSet*>& blocks)
{
  for (unsigned i = 0; i < data->GetNumberOfBlocks(); ++i)
  {
    if (auto* inner = vtkMultiBlockDataSet::SafeDownCast(data->GetBlock(i)))
    {
      collectBlocks(inner, blocks);
    }
    else if (auto* leaf = vtkDataSet::SafeDownCast(data->GetBlock(i)))
    {
      blocks[data->GetMetaData(i)->Get(vtkCompositeDataSet::NAME())] = leaf;
    }
  }
}

class PolyMeshAgrees : public atria::testing::DualMesherTest
{
protected:
  void meshHouse(const char* model)
  {
    mesher->SetInputDataObject(atria::testing::exampleModel(model));
    mesher->SetDomainMode(vtkAtriaDualMesher::Site);
    mesher->SetSizeMax(8.0);
    mesher->SetSizeMid(2.0);
    mesher->SetSizeMin(1.0);
    write();
  }

  void meshSphere(double sizeMin, double sizeMax)
  {
    mesher->SetInputDataObject(atria::testing::exampleModel("sphere_in_cube.wrl"));
    mesher->SetDomainMode(vtkAtriaDualMesher::FromSurfaces);
    mesher->SetSizeMax(sizeMax);
    mesher->SetSizeMid(sizeMin);
    mesher->SetSizeMin(sizeMin);
    write();
  }

  void expectReaderAgrees();
  void expectCheckMeshCountsTheSame(const CheckMeshReport& report);

  /// Faces with a pyramid to the centroid of a cell beside them whose volume is below `smallest`.
  long facesWithPyramidsBelow(double smallest);

  atria::testing::ScratchFolder scratch;
  /// Merged cells and faces are no longer those of the mesher's outputs.
  bool mergeCells = false;
  bool mergeFaces = false;
  vtkIdType mergedCells = 0;
  vtkIdType addedCells = 0;
  vtkIdType mergedFaces = 0;

private:
  void write()
  {
    vtkNew<vtkAtriaOpenFOAMWriter> writer;
    writer->SetInputConnection(mesher->GetOutputPort(0));
    writer->SetPatchesConnection(mesher->GetOutputPort(1));
    writer->SetCaseDirectory(scratch.path().c_str());
    writer->SetMergeUnderdeterminedCells(mergeCells);
    writer->SetMergeCoplanarFaces(mergeFaces);
    ASSERT_EQ(writer->Write(), 1);
    atria::testing::expectCheckWarnings(messages, writer->GetChecks());
    ASSERT_GT(volume()->GetNumberOfCells(), 0);
    mergedCells = writer->GetNumberOfMergedCells();
    addedCells = writer->GetNumberOfAddedCells();
    mergedFaces = writer->GetNumberOfMergedFaces();
  }
};

void PolyMeshAgrees::expectReaderAgrees()
{
  const auto reader = atria::testing::readFoam(scratch.path() / (scratch.path().filename().string() + ".foam"));
  std::map<std::string, vtkDataSet*> blocks;
  collectBlocks(reader->GetOutput(), blocks);
  const auto all = namedPatches();
  for (const auto& [name, patch] : all)
  {
    ASSERT_EQ(blocks.count(name), 1u) << name;
    EXPECT_EQ(blocks.at(name)->GetNumberOfCells(), patch->GetNumberOfCells()) << name;
  }
  auto* readBack = vtkUnstructuredGrid::SafeDownCast(blocks.at("internalMesh"));
  ASSERT_NE(readBack, nullptr);
  ASSERT_EQ(readBack->GetNumberOfCells(), volume()->GetNumberOfCells());
  const std::vector<double> ours = atria::testing::volumesOf(volume(), patches());
  const std::vector<double> theirs = atria::testing::volumesOf(readBack, nullptr);
  for (vtkIdType cell = 0; cell < volume()->GetNumberOfCells(); ++cell)
  {
    // The reader keeps points in single precision.
    double bounds[6];
    volume()->GetCellBounds(cell, bounds);
    const double edge = std::max({bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4]});
    ASSERT_NEAR(ours[cell], theirs[cell], 1e-4 * edge * edge) << "cell " << cell;
  }
}

void PolyMeshAgrees::expectCheckMeshCountsTheSame(const CheckMeshReport& report)
{
  const atria::VtkFaceMesh faces = atria::faceMeshFromVtk(volume(), patches());
  EXPECT_EQ(report.counts.at("cells"), volume()->GetNumberOfCells());
  EXPECT_EQ(report.counts.at("faces"), static_cast<long>(faces.mesh.faceCount()));
  EXPECT_EQ(report.counts.at("internal faces"), static_cast<long>(faces.mesh.internalFaceCount()));
  EXPECT_EQ(report.counts.at("boundary patches"), patches()->GetNumberOfPartitionedDataSets());
  std::map<int, long> types;
  for (vtkIdType cell = 0; cell < volume()->GetNumberOfCells(); ++cell)
  {
    ++types[volume()->GetCellType(cell)];
  }
  EXPECT_EQ(report.cellsByType.at("hexahedra"), types[VTK_HEXAHEDRON]);
  EXPECT_EQ(report.cellsByType.at("prisms"), types[VTK_WEDGE]);
  EXPECT_EQ(report.cellsByType.at("pyramids"), types[VTK_PYRAMID]);
  // Two of our polyhedra have names there.
  EXPECT_EQ(report.cellsByType.at("polyhedra") + report.cellsByType.at("wedges") + report.cellsByType.at("tet wedges"),
            types[VTK_POLYHEDRON]);
  EXPECT_EQ(report.cellsByType.at("tetrahedra"), types[VTK_TETRA]);
  const std::vector<double> volumes = atria::testing::volumesOf(volume(), patches());
  const double total = std::accumulate(volumes.begin(), volumes.end(), 0.0);
  if (!std::isnan(report.totalVolume)) // not printed where some are negative
  {
    EXPECT_NEAR(report.totalVolume, total, 1e-9 * total);
  }
}

long PolyMeshAgrees::facesWithPyramidsBelow(double smallest)
{
  const atria::FaceMesh mesh = atria::faceMeshFromVtk(volume(), patches()).mesh;
  const atria::MeshGeometry geometry = computeGeometry(mesh, makeCellFaces(mesh), atria::testing::quietContext());
  const auto pyramid = [&](std::size_t face, Index cell) {
    return geometry.faceAreas[face].dot(geometry.faceCentroids[face] - geometry.cellCentroids[cell]) / 3.0;
  };
  long count = 0;
  for (std::size_t f = 0; f < mesh.faceCount(); ++f)
  {
    const bool wrong = pyramid(f, mesh.owner[f]) < smallest ||
                       (f < mesh.internalFaceCount() && -pyramid(f, mesh.neighbor[f]) < smallest);
    count += wrong ? 1 : 0;
  }
  return count;
}

TEST_F(PolyMeshAgrees, OnTheHouse)
{
  meshHouse("house.wrl");
  expectReaderAgrees();
}

TEST_F(PolyMeshAgrees, OnTheTurnedHouse)
{
  meshHouse("house_turned17.wrl");
  expectReaderAgrees();
}

TEST_F(PolyMeshAgrees, OnTheSphereUniformAndAdaptive)
{
  for (const double sizeMax : {0.4, 3.2})
  {
    meshSphere(0.4, sizeMax);
    expectReaderAgrees();
  }
}

class CheckMeshAgrees : public PolyMeshAgrees
{
protected:
  void SetUp() override
  {
    if (!atria::testing::haveCheckMesh())
    {
      GTEST_SKIP() << atria::testing::withoutCheckMesh;
    }
  }

  /// Nothing to object to but concave cells, of which the check of all geometry tells.
  void expectSound()
  {
    const CheckMeshReport plain = atria::testing::runCheckMesh(scratch.path(), "-allTopology");
    ASSERT_TRUE(plain.completed) << plain.log;
    EXPECT_EQ(plain.failedChecks, 0) << plain.log;
    expectCheckMeshCountsTheSame(plain);
    const CheckMeshReport all = atria::testing::runCheckMesh(scratch.path());
    EXPECT_THAT(all.failures, Each(HasSubstr("Concave"))) << all.log;
  }

  /// The number after a text in what checkMesh printed, 0 without.
  static long numberAfter(const CheckMeshReport& report, const std::string& text)
  {
    const std::size_t at = report.log.find(text);
    return at == std::string::npos ? 0 : std::stol(report.log.substr(at + text.size()));
  }

  static constexpr const char* smallDeterminants = "small determinant (< 0.001) found, number of cells: ";

  /// What checkMesh says of a model's plain dual written without an option of merging, and with it.
  std::pair<CheckMeshReport, CheckMeshReport> reportWithoutAndWith(bool& option, const char* model)
  {
    mesher->SetNumberOfLayers(0);
    mesher->SetSupportElements(false);
    option = false;
    meshHouse(model);
    EXPECT_EQ(&option == &mergeCells ? mergedCells : mergedFaces, 0);
    CheckMeshReport without = atria::testing::runCheckMesh(scratch.path());
    option = true;
    meshHouse(model);
    return {std::move(without), atria::testing::runCheckMesh(scratch.path())};
  }

  /// Concave cells and small determinants apart.
  static void expectNothingNew(const CheckMeshReport& plain, const CheckMeshReport& merged)
  {
    ASSERT_TRUE(plain.completed && merged.completed) << merged.log;
    EXPECT_LE(merged.failedChecks, plain.failedChecks) << merged.log;
    for (const char* text : {"Error in face pyramids: ", "Error in face tets: ", "Number of negative volume cells: ",
                             "number of open cells "})
    {
      EXPECT_LE(numberAfter(merged, text), numberAfter(plain, text)) << text;
    }
  }

  /// checkMesh finds no more wrong than is counted as invalid. Where elements are flat, rounding decides what it finds.
  void expectNothingHidden()
  {
    vtkNew<vtkAtriaMeshQuality> quality;
    quality->SetInputConnection(mesher->GetOutputPort(0));
    quality->SetPatchesConnection(mesher->GetOutputPort(1));
    quality->Update();
    const CheckMeshReport report = atria::testing::runCheckMesh(scratch.path());
    ASSERT_TRUE(report.completed) << report.log;
    expectCheckMeshCountsTheSame(report);
    constexpr double rounding = 1e-9;
    const long wrongFaces = numberAfter(report, "Error in face pyramids: ");
    EXPECT_GE(wrongFaces, facesWithPyramidsBelow(-rounding));
    EXPECT_LE(wrongFaces, facesWithPyramidsBelow(rounding));
    constexpr long mostFaces = 6;
    EXPECT_LE(wrongFaces, mostFaces * quality->GetNumberOfInvalidCells());
    EXPECT_LE(numberAfter(report, "Number of negative volume cells: "), quality->GetNumberOfInvalidCells());
    EXPECT_LE(numberAfter(report, "number of open cells "), quality->GetNumberOfInvalidCells());
  }
};

TEST_F(CheckMeshAgrees, TheUniformSphereIsSound)
{
  meshSphere(0.5, 0.5);
  expectSound();
}

TEST_F(CheckMeshAgrees, TheAdaptiveSphereIsSound)
{
  meshSphere(0.5, 4.0);
  expectSound();
}

TEST_F(CheckMeshAgrees, ASphereWithALayerIsSoundConcaveCellsIncluded)
{
  mesher->SetNumberOfLayers(1);
  meshSphere(0.5, 0.5);
  const CheckMeshReport report = atria::testing::runCheckMesh(scratch.path());
  ASSERT_TRUE(report.completed) << report.log;
  EXPECT_EQ(report.failedChecks, 0) << report.log;
  expectCheckMeshCountsTheSame(report);
}

TEST_F(CheckMeshAgrees, NoInvalidElementOfTheTurnedHouseWithLayersIsHidden)
{
  mesher->SetNumberOfLayers(3);
  meshHouse("house_turned17.wrl");
  expectNothingHidden();
}

TEST_F(CheckMeshAgrees, ASphereWhosePoleIsAGridPointHasNoFaceWithoutArea)
{
  meshSphere(0.4, 3.2);
  const CheckMeshReport report = atria::testing::runCheckMesh(scratch.path());
  EXPECT_THAT(report.failures, Each(AnyOf(HasSubstr("Concave"), HasSubstr("skewness")))) << report.log;
}

TEST_F(CheckMeshAgrees, NoCheckFailsWithoutLayersWhereTheySupportElements)
{
  mesher->SetNumberOfLayers(0);
  mergeCells = mergeFaces = true;
  for (const char* model : {"house.wrl", "house_turned17.wrl"})
  {
    SCOPED_TRACE(model);
    meshHouse(model);
    const CheckMeshReport report = atria::testing::runCheckMesh(scratch.path());
    EXPECT_EQ(report.failedChecks, 0) << report.log;
  }
}

TEST_F(CheckMeshAgrees, MergedFacesLeaveFewerConcaveCellsAndNothingNewToObjectTo)
{
  for (const char* model : {"house.wrl", "house_turned17.wrl"})
  {
    SCOPED_TRACE(model);
    const auto [plain, merged] = reportWithoutAndWith(mergeFaces, model);
    EXPECT_GT(mergedFaces, 0);
    EXPECT_EQ(merged.counts.at("cells"), plain.counts.at("cells"));
    EXPECT_EQ(merged.counts.at("internal faces"), plain.counts.at("internal faces"));
    EXPECT_EQ(merged.counts.at("faces"), plain.counts.at("faces") - mergedFaces);
    const std::string concave = "Concave cells (using face planes) found, number of cells: ";
    EXPECT_GT(numberAfter(plain, concave), 50);
    // Flat elements and those with coplanar faces inside the mesh are left.
    EXPECT_LT(numberAfter(merged, concave), 0.5 * numberAfter(plain, concave));
    EXPECT_LE(numberAfter(merged, smallDeterminants), numberAfter(plain, smallDeterminants));
    expectNothingNew(plain, merged);
  }
}

TEST_F(CheckMeshAgrees, MergedCellsLeaveFewWithTooFewNeighborsAndNothingNewToObjectTo)
{
  mergeFaces = true;
  for (const char* model : {"house.wrl", "house_turned17.wrl"})
  {
    SCOPED_TRACE(model);
    const auto [plain, merged] = reportWithoutAndWith(mergeCells, model);
    EXPECT_GT(mergedCells, 10);
    EXPECT_EQ(merged.counts.at("cells"), plain.counts.at("cells") - mergedCells + addedCells);
    EXPECT_EQ(merged.counts.at("boundary patches"), plain.counts.at("boundary patches"));
    EXPECT_GT(numberAfter(plain, smallDeterminants), 10);
    EXPECT_LT(numberAfter(merged, smallDeterminants), 0.2 * numberAfter(plain, smallDeterminants));
    expectNothingNew(plain, merged);
  }
}

TEST_F(CheckMeshAgrees, NoInvalidElementOfTheHouseIsHidden)
{
  meshHouse("house.wrl");
  expectNothingHidden();
}

TEST_F(CheckMeshAgrees, NoInvalidElementOfTheTurnedHouseIsHidden)
{
  meshHouse("house_turned17.wrl");
  expectNothingHidden();
}

} // namespace
