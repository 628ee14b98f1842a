// SPDX-License-Identifier: GPL-3.0-or-later
/// What ranks write.
#include "OnRanks.h"
#include "Ranks/VtkPieces.h"
#include "vtkAtriaMeshQuality.h"
#include "vtkAtriaOpenFOAMWriter.h"

#include <vtkCellArray.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>

#include <unistd.h>

namespace {

using namespace atria::testing;

/// What one process reads of pieces that ranks have written.
template <typename Reader> vtkSmartPointer<vtkDataObject> read(const std::string& file)
{
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

class WrittenPieces : public OnRanks
{
protected:
  WrittenPieces()
  {
    int process = static_cast<int>(getpid()); // the first rank's, in the name of one folder for all
    controller()->Broadcast(&process, 1, 0);
    folder = std::filesystem::temp_directory_path() / ("atria_ranks_" + std::to_string(process));
    std::filesystem::create_directories(folder);
  }
  ~WrittenPieces() override
  {
    controller()->Barrier();
    if (rank() == 0)
    {
      std::filesystem::remove_all(folder);
    }
  }

  std::string file(const char* name) { return (folder / name).string(); }

private:
  std::filesystem::path folder;
};

TEST_F(WrittenPieces, AreTheMeshAgain)
{
  if (ranks() == 1)
  {
    return; // TestRecordedPatches has meshes that are read as they are
  }
  vtkNew<vtkAtriaMeshQuality> quality; // which has the whole to itself
  quality->SetInputConnection(mesher->GetOutputPort(0));
  quality->Update();
  vtkNew<vtkUnstructuredGrid> alone;
  alone->DeepCopy(quality->GetOutput());
  vtkNew<vtkXMLPUnstructuredGridWriter> writer;
  const std::string name = file("mesh.pvtu");
  writer->SetFileName(name.c_str());
  update(mesher);
  writer->SetInputDataObject(volume());
  writer->SetNumberOfPieces(ranks());
  writer->SetStartPiece(rank());
  writer->SetEndPiece(rank());
  EXPECT_EQ(writer->Write(), 1);
  controller()->Barrier();
  if (rank() == 0)
  {
    const auto pieces = read<vtkXMLPUnstructuredGridReader>(name);
    EXPECT_GT(pieces->GetNumberOfElements(vtkDataObject::CELL), alone->GetNumberOfCells()); // with ghosts
    quality->SetInputDataObject(pieces);
    quality->UpdatePiece(0, 1, 0);
    quality->GetOutput()->GetCells()->ConvertTo32BitStorage(); // files have 64 bits
    EXPECT_TRUE(identical(alone, quality->GetOutput()));
  }
}

TEST_F(WrittenPieces, OfPatchesAreThePatchesAgain)
{
  const auto alone = whole();
  update(mesher);
  vtkNew<vtkXMLPartitionedDataSetCollectionWriter> writer;
  const std::string name = file("patches.vtpc");
  writer->SetFileName(name.c_str());
  writer->SetInputDataObject(patches());
  EXPECT_EQ(writer->Write(), 1);
  controller()->Barrier();
  if (rank() == 0)
  {
    const auto pieces = read<vtkXMLPartitionedDataSetCollectionReader>(name);
    EXPECT_TRUE(identical(alone[1], atria::inOnePiece(pieces)));
  }
}

namespace fs = std::filesystem;

std::string textOf(const fs::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The files of a case's processors, by their place in it.
std::map<std::string, std::string> processorFiles(const fs::path& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
  {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (entry.is_regular_file() && name.find("processor") != std::string::npos)
    {
      files[name] = textOf(entry.path());
    }
  }
  return files;
}

/// A list of labels on file, as text.
std::vector<vtkIdType> labelsOf(const fs::path& file)
{
  std::string text = textOf(file);
  text.erase(0, text.find('('));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == '/' || c == '*'; }, ' ');
  std::istringstream stream(text);
  return {std::istream_iterator<vtkIdType>(stream), {}};
}

/// The processors of a case.
class WrittenProcessors : public WrittenPieces
{
protected:
  WrittenProcessors() { writer->UseRanksAsProcessorsOn(); }

  /// Writes what each rank holds.
  int write(const std::string& caseFolder) { return write(volume(), patches(), caseFolder); }
  int write(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* its, const std::string& caseFolder)
  {
    writer->SetInputDataObject(0, mesh);
    writer->SetInputDataObject(1, its);
    writer->SetCaseDirectory(caseFolder.c_str());
    writer->SetNumberOfPieces(ranks());
    writer->SetPiece(rank());
    const int written = writer->Write();
    controller()->Barrier();
    return written;
  }

  /// Writes the mesh with and without the whole.
  void expectSameWithoutTheWhole(const std::string& name)
  {
    update(mesher);
    writer->WriteWholeMeshOn();
    ASSERT_EQ(write(name), 1);
    const auto processors = processorFiles(name);
    const int failed = writer->GetNumberOfFailedChecks();
    const vtkIdType merged = writer->GetNumberOfMergedCells(), added = writer->GetNumberOfAddedCells(),
                    mergedFaces = writer->GetNumberOfMergedFaces();
    writer->WriteWholeMeshOff();
    for (vtkPartitionedDataSetCollection* given : {patches(), static_cast<vtkPartitionedDataSetCollection*>(nullptr)})
    {
      ASSERT_EQ(write(volume(), given, name), 1);
      EXPECT_EQ(processorFiles(name), processors);
      EXPECT_EQ(fs::exists(fs::path(name) / "constant" / "polyMesh" / "points"), ranks() == 1);
      if (rank() == 0)
      {
        EXPECT_EQ(writer->GetNumberOfFailedChecks(), failed);
        EXPECT_EQ(writer->GetNumberOfMergedCells(), merged);
        EXPECT_EQ(writer->GetNumberOfAddedCells(), added);
        EXPECT_EQ(writer->GetNumberOfMergedFaces(), mergedFaces);
      }
    }
  }

  vtkNew<vtkAtriaOpenFOAMWriter> writer;
};

TEST_F(WrittenProcessors, HaveTheCellsOfTheRanks)
{
  writer->MergeUnderdeterminedCellsOff();
  writer->MergeCoplanarFacesOff();
  update(mesher);
  ASSERT_EQ(write(file("case")), 1);
  const fs::path own = fs::path(file("case")) / ("processor" + std::to_string(rank())) / "constant" / "polyMesh";
  EXPECT_EQ(fs::exists(own), ranks() > 1); // one has the mesh of the case
  if (ranks() > 1)
  {
    const std::set<vtkIdType> cells = ownCells();
    EXPECT_EQ(labelsOf(own / "cellProcAddressing"), std::vector<vtkIdType>(cells.begin(), cells.end()));
  }
}

TEST_F(WrittenProcessors, AreTheSameWhereOneRankHoldsTheMesh)
{
  update(mesher);
  ASSERT_EQ(write(file("pieces")), 1);
  mesher->DistributeOutputOff();
  update(mesher);
  ASSERT_EQ(write(file("whole")), 1);
  EXPECT_EQ(processorFiles(file("pieces")), processorFiles(file("whole")));
  EXPECT_EQ(processorFiles(file("pieces")).empty(), ranks() == 1);
}

TEST_F(WrittenProcessors, AreTheSameWithoutTheWholeMesh)
{
  int count = 0;
  for (const int blockSize : {0, 1000})
  {
    mesher->SetBlockSize(blockSize);
    for (const bool allZones : {false, true})
    {
      mesher->SetZoneRule(allZones ? vtkAtriaDualMesher::All : vtkAtriaDualMesher::Outside);
      writer->SetWriteBinary(allZones);
      expectSameWithoutTheWhole(file("case") + std::to_string(count++));
    }
  }
}

TEST_F(WrittenProcessors, HaveFaceZonesAndCellZonesWithoutTheWholeMesh)
{
  int count = 0;
  mesher->AddFaceZone("Canopy");
  mesher->AddCellZone("Dome");
  mesher->SetZoneRule(vtkAtriaDualMesher::All);
  for (const int blockSize : {0, 1000})
  {
    for (const int layers : {0, 2})
    {
      mesher->SetBlockSize(blockSize);
      mesher->SetNumberOfLayers(layers);
      const std::string name = file("case") + std::to_string(count++);
      expectSameWithoutTheWhole(name);
      std::size_t faces = 0;
      for (const auto& [path, text] : processorFiles(name))
      {
        faces += path.find("faceZones") != std::string::npos && text.find("Canopy") != std::string::npos ? 1 : 0;
      }
      EXPECT_EQ(faces, ranks() == 1 ? 0U : static_cast<std::size_t>(ranks()));
    }
  }
}

TEST_F(WrittenProcessors, AreAllThereOrNone)
{
  if (ranks() == 1)
  {
    return;
  }
  update(mesher);
  std::ofstream(file("file").c_str()) << "no folder";
  controller()->Barrier();
  const bool isLast = rank() == ranks() - 1;
  for (const bool withWhole : {true, false})
  {
    writer->SetWriteWholeMesh(withWhole);
    const std::string name = file(withWhole ? "case" : "pieces");
    EXPECT_EQ(write(isLast ? file("file") : name), 0);
    const auto errors = messages.takeErrors();
    if (rank() == 0)
    {
      EXPECT_THAT(firstOf(errors), ::testing::HasSubstr("rank " + std::to_string(ranks() - 1) + ": cannot make"));
    }
    else
    {
      EXPECT_TRUE(errors.empty());
    }
    EXPECT_FALSE(fs::exists(name)); // and no mesh without them
    EXPECT_EQ(write(name), 1);      // all go on
    EXPECT_FALSE(processorFiles(name).empty());
  }
}

TEST_F(WrittenProcessors, HaveCellsEach)
{
  vtkNew<vtkUnstructuredGrid> cube;
  if (rank() == 0)
  {
    vtkNew<vtkPoints> points;
    for (int corner = 0; corner < 8; ++corner)
    {
      points->InsertNextPoint(corner & 1, (corner >> 1) & 1, corner >> 2);
    }
    cube->SetPoints(points);
    const std::array<vtkIdType, 8> corners{0, 1, 2, 3, 4, 5, 6, 7};
    cube->InsertNextCell(VTK_VOXEL, 8, corners.data());
  }
  EXPECT_EQ(write(cube, nullptr, file("case")), ranks() == 1 ? 1 : 0);
  messages.takeWarnings(); // one cell fails checks
  const auto errors = messages.takeErrors();
  if (rank() == 0 && ranks() > 1)
  {
    EXPECT_THAT(firstOf(errors), ::testing::HasSubstr("cannot be divided"));
  }
}

} // namespace
