// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh records its patches, so that nobody loses their names who writes it alone.
#include "DualMesherTest.h"
#include "Support/CheckMesh.h"
#include "Support/CheckWarnings.h"
#include "Support/SampleGrid.h"
#include "Support/TestPaths.h"
#include "VtkFaceMesh.h"
#include "VtkRecordedPatches.h"
#include "vtkAtriaMeshOptimizer.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkPointData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkThreshold.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <gmock/gmock.h>

#include <limits>

namespace {

namespace fs = std::filesystem;
using atria::faceMeshFromVtk;
using atria::Index;
using atria::PatchOrigin;
using atria::Vec3;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// The files of a case's mesh, with their text.
std::map<std::string, std::string> filesOf(const fs::path& folder)
{
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& file : fs::directory_iterator(folder / "constant/polyMesh"))
  {
    files[file.path().filename().string()] = atria::testing::bytesOf(file.path());
  }
  return files;
}

class RecordedPatches : public atria::testing::DualMesherTest
{
protected:
  /// A building, a canopy with fluid on both sides, and a leaf so small that both sides of it are one face.
  RecordedPatches()
  {
    atria::TriangleSurface surface;
    atria::testing::addBox(surface, "Building ä", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
    atria::testing::addSheet(surface, "Canopy", Vec3(-1.7, -3.2, 2.1), Vec3(2.8, 0, 0), Vec3(0, 1.3, 0));
    atria::testing::addSheet(surface, "Leaf", Vec3(3.1, 1.6, 3.6), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0));
    setSurface(surface);
    mesher->SetNumberOfLayers(0);
    mesher->Update();
  }

  std::map<std::string, std::string> write(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* ownPatches)
  {
    const fs::path folder = scratch.path() / "case";
    vtkNew<vtkAtriaOpenFOAMWriter> writer;
    writer->SetInputDataObject(mesh);
    if (ownPatches)
    {
      writer->SetPatchesData(ownPatches);
    }
    writer->SetCaseDirectory(folder.c_str());
    EXPECT_EQ(writer->Write(), 1);
    atria::testing::expectCheckWarnings(messages, writer->GetChecks());
    return filesOf(folder);
  }

  /// All of the boundary is one patch, and a warning says why.
  void expectLost(vtkUnstructuredGrid* mesh, const char* reason)
  {
    const std::string boundary = write(mesh, nullptr).at("boundary");
    EXPECT_THAT(boundary, HasSubstr("\n1\n("));
    EXPECT_THAT(boundary, HasSubstr("defaultFaces"));
    EXPECT_THAT(messages.takeWarnings(), ElementsAre(HasSubstr(reason)));
    if (!atria::testing::haveCheckMesh())
    {
      GTEST_SKIP() << atria::testing::withoutCheckMesh;
    }
    const auto report = atria::testing::runCheckMesh(scratch.path() / "case");
    EXPECT_TRUE(report.completed) << report.log;
    EXPECT_THAT(report.failures, Each(Not(HasSubstr("open")))) << report.log;
  }

  vtkSmartPointer<vtkUnstructuredGrid> copy()
  {
    auto mesh = vtkSmartPointer<vtkUnstructuredGrid>::New();
    mesh->DeepCopy(volume());
    return mesh;
  }

  /// As after a filter that keeps the cells from `first` to `last`.
  vtkSmartPointer<vtkUnstructuredGrid> cellsOf(double first, double last)
  {
    const auto numbered = copy();
    vtkNew<vtkDoubleArray> numbers;
    numbers->SetName("Number");
    for (vtkIdType cell = 0; cell < numbered->GetNumberOfCells(); ++cell)
    {
      numbers->InsertNextValue(static_cast<double>(cell));
    }
    numbered->GetCellData()->AddArray(numbers);
    vtkNew<vtkThreshold> threshold;
    threshold->SetInputData(numbered);
    threshold->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Number");
    threshold->SetLowerThreshold(first);
    threshold->SetUpperThreshold(last);
    threshold->Update();
    return threshold->GetOutput();
  }

  double lastCell() { return static_cast<double>(volume()->GetNumberOfCells() - 1); }

  atria::testing::ScratchFolder scratch;
};

TEST_F(RecordedPatches, MakeTheSameCaseAsPatchesThatAreGiven)
{
  const auto given = write(volume(), patches());
  EXPECT_THAT(given.at("boundary"), HasSubstr("Leaf_front"));
  EXPECT_THAT(given.at("boundary"), HasSubstr("\"Building ä\""));
  EXPECT_THAT(given.at("boundary"), Not(HasSubstr("defaultFaces")));
  EXPECT_EQ(write(volume(), nullptr), given);
}

TEST_F(RecordedPatches, KeepSidesOfASheetThatIsOneFaceWide)
{
  const auto plain = copy();
  plain->GetFieldData()->Initialize();
  const auto boundaryFaces = [](const atria::VtkFaceMesh& faces) {
    return faces.mesh.faceCount() - faces.mesh.internalFaceCount();
  };
  const atria::VtkFaceMesh recorded = faceMeshFromVtk(volume(), nullptr);
  EXPECT_EQ(recorded.origin, PatchOrigin::Recorded);
  EXPECT_GT(boundaryFaces(recorded), boundaryFaces(faceMeshFromVtk(plain, nullptr)));
  EXPECT_EQ(boundaryFaces(recorded), boundaryFaces(faceMeshFromVtk(volume(), patches())));
}

TEST_F(RecordedPatches, OutliveAFile)
{
  const auto given = write(volume(), patches());
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
  {
    const std::string file = scratch.path() / "mesh.vtu";
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetInputData(volume());
    writer->SetFileName(file.c_str());
    writer->SetDataMode(mode);
    ASSERT_EQ(writer->Write(), 1);
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName(file.c_str());
    reader->Update();
    const auto read = write(reader->GetOutput(), nullptr);
    EXPECT_EQ(read.at("boundary"), given.at("boundary")) << mode;
    EXPECT_EQ(read.at("faces"), given.at("faces")) << mode;
    EXPECT_EQ(read.at("owner"), given.at("owner")) << mode;
  }
}

TEST_F(RecordedPatches, ServeQualityAndOptimizer)
{
  vtkNew<vtkAtriaMeshQuality> quality;
  vtkNew<vtkAtriaMeshOptimizer> optimizer;
  vtkSmartPointer<vtkDataObject> measured[2];
  vtkSmartPointer<vtkUnstructuredGrid> improved[2];
  for (const bool given : {false, true})
  {
    quality->SetInputDataObject(0, volume());
    quality->SetPatchesData(given ? patches() : nullptr);
    quality->Update();
    measured[given].TakeReference(quality->GetOutputDataObject(0)->NewInstance());
    measured[given]->DeepCopy(quality->GetOutputDataObject(0));
    optimizer->SetInputDataObject(0, volume());
    optimizer->SetPatchesData(given ? patches() : nullptr);
    optimizer->SetTargetNonOrthogonality(20.0);
    optimizer->Update();
    improved[given] = vtkSmartPointer<vtkUnstructuredGrid>::New();
    improved[given]->DeepCopy(optimizer->GetOutputDataObject(0));
  }
  EXPECT_TRUE(atria::testing::identical(measured[0], measured[1]));
  EXPECT_TRUE(atria::testing::identical(improved[0], improved[1]));
  ASSERT_GT(optimizer->GetNumberOfMovedPoints(), 0);
  EXPECT_EQ(write(improved[0], nullptr), write(improved[0], patches()));
}

TEST_F(RecordedPatches, TakeTwentyBytesAFace)
{
  vtkIdType faces = 0;
  for (const auto& [name, patch] : namedPatches())
  {
    faces += patch->GetNumberOfCells();
  }
  vtkDataArray* recorded = volume()->GetFieldData()->GetArray("PatchFace");
  EXPECT_EQ(recorded->GetDataSize() * recorded->GetDataTypeSize(), 20 * faces);
}

TEST_F(RecordedPatches, AreLostWhereCellsAreLeftOut)
{
  const double last = lastCell();
  const auto tail = cellsOf(1, last); // all others have other numbers
  const auto head = cellsOf(0, last - 1);
  const auto some = cellsOf(last / 3, last / 2);
  for (vtkUnstructuredGrid* mesh : {tail.Get(), head.Get(), some.Get()})
  {
    EXPECT_TRUE(atria::hasRecordedPatches(mesh));
    expectLost(mesh, "names of the patches are lost");
  }
  // Patches that are given are taken as ever, and wrong ones are an error.
  vtkNew<vtkAtriaOpenFOAMWriter> writer;
  writer->SetInputDataObject(some);
  writer->SetPatchesData(patches());
  writer->SetCaseDirectory((scratch.path() / "case").c_str());
  EXPECT_EQ(writer->Write(), 0);
  EXPECT_EQ(messages.takeErrors().size(), 1u);
}

TEST_F(RecordedPatches, AreNotTakenFromArraysOfOtherKinds)
{
  const auto spoil = [&](auto&& change) {
    const auto mesh = copy();
    change(mesh->GetFieldData());
    EXPECT_FALSE(atria::recordedPatches(mesh)) << "is read";
    EXPECT_EQ(faceMeshFromVtk(mesh, nullptr).origin, PatchOrigin::Lost);
  };
  spoil([](vtkFieldData* data) { data->RemoveArray("PatchName"); });
  spoil([](vtkFieldData* data) { data->RemoveArray("PatchFaceCount"); });
  spoil([](vtkFieldData* data) { data->GetArray("PatchFace")->SetNumberOfComponents(2); });
  spoil([](vtkFieldData* data) { data->GetArray("PatchFace")->RemoveLastTuple(); });
  spoil([](vtkFieldData* data) { data->GetArray("PatchFaceCount")->SetComponent(0, 0, -1); });
  spoil([](vtkFieldData* data) { data->GetArray("PatchFaceCount")->SetComponent(0, 0, 1e9); });
  spoil([](vtkFieldData* data) {
    vtkNew<vtkDoubleArray> faces;
    faces->DeepCopy(data->GetArray("PatchFace"));
    faces->SetName("PatchFace");
    faces->SetComponent(0, 2, std::numeric_limits<double>::quiet_NaN());
    data->AddArray(faces);
  });
}

/// Two cubes side by side with their outer faces recorded.
class RecordedPatchesOfTwoCubes : public atria::testing::VtkTest
{
protected:
  RecordedPatchesOfTwoCubes()
  {
    const atria::testing::SampleMesh sample = atria::testing::hexahedra({2, 1, 1});
    grid = atria::testing::toGrid(sample);
    const atria::FaceMesh faces = atria::makeFaceMesh(sample.points, sample.view());
    atria::recordPatches(atria::testing::toPatches(faces, atria::testing::sidesOfBox({2, 1, 1})), grid);
    // The face between them.
    shared.assign(faces.face(0).begin(), faces.face(0).end());
  }

  PatchOrigin origin() { return faceMeshFromVtk(grid, nullptr).origin; }

  void setFace(vtkIdType f, Index cell, const std::vector<Index>& points)
  {
    vtkDataArray* faces = grid->GetFieldData()->GetArray("PatchFace");
    const double values[]{double(cell), double(points[0]), double(points[1]), double(points[2]), double(points[3])};
    faces->SetTuple(f, values);
  }

  vtkSmartPointer<vtkUnstructuredGrid> grid;
  std::vector<Index> shared;
};

TEST_F(RecordedPatchesOfTwoCubes, AreTaken) { EXPECT_EQ(origin(), PatchOrigin::Recorded); }

TEST_F(RecordedPatchesOfTwoCubes, AreLostWithAFaceBetweenTwoCells)
{
  setFace(0, 0, shared);
  EXPECT_EQ(origin(), PatchOrigin::Lost);
}

TEST_F(RecordedPatchesOfTwoCubes, AreLostWithAFaceThatIsThereTwice)
{
  vtkDataArray* faces = grid->GetFieldData()->GetArray("PatchFace");
  faces->SetTuple(0, 1, faces);
  EXPECT_EQ(origin(), PatchOrigin::Lost);
}

TEST_F(RecordedPatchesOfTwoCubes, AreLostWithACellOrPointsThatAreNotThere)
{
  setFace(0, 7, shared);
  EXPECT_EQ(origin(), PatchOrigin::Lost);
  setFace(0, 0, {100, 101, 102, 103});
  EXPECT_EQ(origin(), PatchOrigin::Lost);
}

TEST_F(RecordedPatchesOfTwoCubes, AreWarnedOfWhereThereNeverWereAny)
{
  grid->GetFieldData()->Initialize();
  EXPECT_EQ(origin(), PatchOrigin::None);
  const atria::testing::ScratchFolder scratch;
  vtkNew<vtkAtriaOpenFOAMWriter> writer;
  writer->SetInputDataObject(grid);
  writer->SetCaseDirectory(scratch.path().c_str());
  EXPECT_EQ(writer->Write(), 1);
  EXPECT_EQ(messages.takeWarnings("No patches were given").size(), 1u);
  EXPECT_EQ(atria::testing::expectCheckWarnings(messages, writer->GetChecks()), 1)
      << "two cells have one neighbor each";
}

} // namespace
