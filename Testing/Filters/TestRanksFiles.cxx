// SPDX-License-Identifier: GPL-3.0-or-later
/// What ranks write.
#include "OnRanks.h"
#include "VtkPieces.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCellArray.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>

#include <gmock/gmock.h>

#include <filesystem>
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

} // namespace
