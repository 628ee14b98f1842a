// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh on MPI ranks: started by mpiexec, every rank runs every test.
#include "DualMesherTest.h"
#include "MeshPiece.h"
#include "Transport.h"
#include "VtkFaceMesh.h"
#include "VtkPieces.h"
#include "vtkAtriaMeshOptimizer.h"
#include "vtkAtriaMeshQuality.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommunicator.h>
#include <vtkCompositeDataSet.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkMPIController.h>
#include <vtkPointData.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLPUnstructuredGridReader.h>
#include <vtkXMLPUnstructuredGridWriter.h>
#include <vtkXMLPartitionedDataSetCollectionReader.h>
#include <vtkXMLPartitionedDataSetCollectionWriter.h>

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include <unistd.h>

namespace {

using atria::TriangleSurface;
using atria::Vec3;
using atria::testing::identical;
using ::testing::HasSubstr;

vtkMultiProcessController* controller() { return vtkMultiProcessController::GetGlobalController(); }
int rank() { return controller()->GetLocalProcessId(); }
int ranks() { return controller()->GetNumberOfProcesses(); }

vtkIdType sumOverRanks(vtkIdType own)
{
  vtkIdType sum = 0;
  controller()->AllReduce(&own, &sum, 1, vtkCommunicator::SUM_OP);
  return sum;
}

vtkIdType greatestOverRanks(vtkIdType own)
{
  vtkIdType greatest = 0;
  controller()->AllReduce(&own, &greatest, 1, vtkCommunicator::MAX_OP);
  return greatest;
}

/// The pieces of all ranks as one, on the first; null on others.
vtkSmartPointer<vtkDataObject> gathered(vtkDataObject* piece)
{
  if (rank() > 0)
  {
    atria::sendData(piece, 0, *controller());
    return nullptr;
  }
  std::vector<vtkSmartPointer<vtkDataObject>> pieces{piece};
  for (int other = 1; other < ranks(); ++other)
  {
    pieces.push_back(atria::receiveData(other, *controller()));
  }
  std::erase_if(pieces, [](vtkDataObject* each) { return atria::isEmptyPiece(each); });
  return pieces.empty() ? nullptr : atria::joinPieces(pieces);
}

void expectGathered(vtkDataObject* piece, vtkDataObject* whole)
{
  const auto joined = gathered(piece);
  if (joined && ranks() > 1)
  {
    EXPECT_TRUE(identical(whole, joined));
  }
}

/// Solids, a sheet with two sides, and a curved wall.
TriangleSurface scene()
{
  TriangleSurface surface;
  atria::testing::addBox(surface, "Building", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
  atria::testing::addSheet(surface, "Canopy", Vec3(-1.7, -3.2, 2.1), Vec3(2.8, 0, 0), Vec3(0, 1.3, 0));
  atria::testing::addSphere(surface, "Dome", Vec3(4.1, 1.3, 2.2), 1.4, 2);
  return surface;
}

/// Whether values are equal but for rounding: angles of boxes are 0 or what the arc cosine makes of that.
void expectNear(double value, double wanted, const std::string& what)
{
  const double most = what.find("NonOrthogonality") != std::string::npos ? 1e-5 : 1e-9;
  EXPECT_LE(std::abs(value - wanted), most * std::max({1.0, std::abs(value), std::abs(wanted)})) << what;
}

void expectNear(vtkTable* table, vtkTable* wanted)
{
  ASSERT_EQ(table->GetNumberOfRows(), wanted->GetNumberOfRows());
  for (vtkIdType row = 0; row < wanted->GetNumberOfRows(); ++row)
  {
    const std::string metric = wanted->GetValueByName(row, "Metric").ToString();
    EXPECT_EQ(table->GetValueByName(row, "Metric").ToString(), metric);
    EXPECT_EQ(table->GetValueByName(row, "Count"), wanted->GetValueByName(row, "Count")) << metric;
    for (const char* column : {"Minimum", "Maximum", "Mean", "StandardDeviation"})
    {
      expectNear(table->GetValueByName(row, column).ToDouble(), wanted->GetValueByName(row, column).ToDouble(),
                 metric + " " + column);
    }
  }
}

/// The values of all cells of a piece, ghosts among them, are those of the whole.
void expectNear(vtkUnstructuredGrid* piece, vtkUnstructuredGrid* whole)
{
  vtkDataArray* ids = piece->GetCellData()->GetGlobalIds();
  for (int i = 0; i < whole->GetCellData()->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* wanted = whole->GetCellData()->GetArray(i);
    vtkDataArray* values = piece->GetCellData()->GetArray(wanted->GetName());
    ASSERT_NE(values, nullptr) << wanted->GetName();
    for (vtkIdType cell = 0; cell < piece->GetNumberOfCells(); ++cell)
    {
      const vtkIdType id = ids ? static_cast<vtkIdType>(ids->GetComponent(cell, 0)) : cell;
      const double value = values->GetComponent(cell, 0), inWhole = wanted->GetComponent(id, 0);
      if (!std::isnan(value) || !std::isnan(inWhole))
      {
        expectNear(value, inWhole, wanted->GetName());
      }
    }
  }
}

class OnRanks : public atria::testing::DualMesherTest
{
protected:
  OnRanks()
  {
    setSurface(scene());
    mesher->SetNumberOfLayers(2);
  }

  /// What one process makes, here on each rank by itself.
  std::array<vtkSmartPointer<vtkDataObject>, 3> whole() { return copiesOfOutputs(); }

  /// The first rank has the model.
  void update(vtkAlgorithm* algorithm, int ghostLevels = 0)
  {
    if (rank() > 0 && !hasNothing)
    {
      hasNothing = true;
      mesher->SetInputDataObject(vtkNew<vtkPolyData>());
    }
    algorithm->UpdatePiece(rank(), ranks(), ghostLevels);
  }

  vtkIdTypeArray* idsOfCells(vtkDataSet* piece)
  {
    return vtkIdTypeArray::SafeDownCast(piece->GetCellData()->GetGlobalIds());
  }
  vtkIdTypeArray* idsOfPoints(vtkDataSet* piece)
  {
    return vtkIdTypeArray::SafeDownCast(piece->GetPointData()->GetGlobalIds());
  }

  /// Global ids of the rank's own cells.
  std::set<vtkIdType> ownCells()
  {
    std::set<vtkIdType> own;
    vtkUnsignedCharArray* ghosts = volume()->GetCellGhostArray();
    for (vtkIdType cell = 0; cell < volume()->GetNumberOfCells(); ++cell)
    {
      if (!ghosts || ghosts->GetValue(cell) == 0)
      {
        own.insert(ranks() > 1 ? idsOfCells(volume())->GetValue(cell) : cell);
      }
    }
    return own;
  }

  bool hasNothing = false;
};

TEST_F(OnRanks, PiecesMakeTheMeshOfOneProcess)
{
  const auto alone = whole();
  update(mesher);
  expectGathered(volume(), alone[0]);
  expectGathered(patches(), alone[1]);
  if (rank() == 0)
  {
    EXPECT_TRUE(identical(alone[2], diagnostics()));
  }
  else
  {
    EXPECT_EQ(diagnostics()->GetNumberOfPoints(), 0);
  }
}

TEST_F(OnRanks, PiecesAreEquallyLarge)
{
  const vtkIdType cells = whole()[0]->GetNumberOfElements(vtkDataObject::CELL);
  update(mesher);
  const auto own = static_cast<vtkIdType>(ownCells().size());
  EXPECT_EQ(sumOverRanks(own), cells);
  EXPECT_LE(greatestOverRanks(own) * ranks(), cells + ranks() - 1);
}

/// Ids of the cells of a mesh that are some rings about others.
std::set<vtkIdType> withRings(vtkUnstructuredGrid* mesh, std::set<vtkIdType> cells, int rings)
{
  vtkNew<vtkIdList> points;
  vtkNew<vtkIdList> neighbors;
  for (int ring = 0; ring < rings; ++ring)
  {
    for (const vtkIdType cell : std::set<vtkIdType>(cells))
    {
      mesh->GetCellPoints(cell, points);
      for (const vtkIdType point : *points)
      {
        mesh->GetPointCells(point, neighbors);
        cells.insert(neighbors->begin(), neighbors->end());
      }
    }
  }
  return cells;
}

TEST_F(OnRanks, GhostsAreTheCellsAbout)
{
  if (ranks() == 1)
  {
    return;
  }
  const auto alone = whole();
  for (const int levels : {0, 1, 2})
  {
    update(mesher, levels);
    vtkIdTypeArray* ids = idsOfCells(volume());
    const std::set<vtkIdType> all(ids->Begin(), ids->End());
    EXPECT_EQ(all, withRings(vtkUnstructuredGrid::SafeDownCast(alone[0]), ownCells(), std::max(levels, 1)));
    EXPECT_EQ(volume()->GetInformation()->Get(vtkDataObject::DATA_NUMBER_OF_GHOST_LEVELS()), std::max(levels, 1));
  }
}

TEST_F(OnRanks, EveryPointIsOfOneRank)
{
  const auto alone = whole();
  update(mesher);
  vtkUnsignedCharArray* ghosts = volume()->GetPointGhostArray();
  const vtkIdType own = ghosts ? std::count(ghosts->Begin(), ghosts->End(), 0) : volume()->GetNumberOfPoints();
  EXPECT_EQ(sumOverRanks(own), alone[0]->GetNumberOfElements(vtkDataObject::POINT));
}

TEST_F(OnRanks, MoreGhostsAreNoReasonToMeshAnew)
{
  update(mesher);
  const vtkMTimeType made = volume()->GetMTime();
  update(mesher, 1);
  EXPECT_EQ(volume()->GetMTime(), made);
}

TEST_F(OnRanks, FacesOfPatchesAreWithTheirOwners)
{
  const auto alone = whole();
  update(mesher);
  auto* all = vtkPartitionedDataSetCollection::SafeDownCast(alone[1]);
  ASSERT_EQ(patches()->GetNumberOfPartitionedDataSets(), all->GetNumberOfPartitionedDataSets());
  const std::set<vtkIdType> own = ownCells();
  for (unsigned int i = 0; i < all->GetNumberOfPartitionedDataSets(); ++i)
  {
    EXPECT_STREQ(patches()->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()),
                 all->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()));
    ASSERT_EQ(patches()->GetNumberOfPartitions(i), 1u);
    auto* patch = vtkPolyData::SafeDownCast(patches()->GetPartitionAsDataObject(i, 0));
    EXPECT_EQ(sumOverRanks(patch->GetNumberOfCells()),
              all->GetPartitionAsDataObject(i, 0)->GetNumberOfElements(vtkDataObject::CELL));
    auto* owners = vtkIdTypeArray::SafeDownCast(patch->GetCellData()->GetArray("OwnerCellId"));
    EXPECT_TRUE(std::all_of(owners->Begin(), owners->End(), [&](vtkIdType owner) { return own.contains(owner); }));
  }
}

TEST_F(OnRanks, FieldDataIsEverywhere)
{
  const auto alone = whole();
  update(mesher);
  vtkFieldData* fields = volume()->GetFieldData();
  ASSERT_EQ(fields->GetNumberOfArrays(), alone[0]->GetFieldData()->GetNumberOfArrays());
  EXPECT_EQ(fields->GetArray("PatchFace")->GetNumberOfTuples(),
            alone[0]->GetFieldData()->GetArray("PatchFace")->GetNumberOfTuples());
}

TEST_F(OnRanks, TheFirstHasItAllWhereThatIsAskedFor)
{
  const auto alone = whole();
  mesher->DistributeOutputOff();
  update(mesher);
  if (rank() == 0)
  {
    EXPECT_TRUE(identical(alone[0], volume()));
    EXPECT_TRUE(identical(alone[1], patches()));
  }
  else
  {
    EXPECT_EQ(volume()->GetNumberOfCells(), 0);
    EXPECT_EQ(patches()->GetNumberOfPartitionedDataSets(),
              vtkPartitionedDataSetCollection::SafeDownCast(alone[1])->GetNumberOfPartitionedDataSets());
  }
}

TEST_F(OnRanks, RanksMayHaveNothing)
{
  mesher->SetNumberOfLayers(0);
  mesher->SetInputDataObject(vtkNew<vtkPolyData>());
  atria::testing::setGrid(mesher, {Vec3(0, 0, 0), Vec3(4, 4, 4)}, 2.0, 2.0, 2.0);
  const auto alone = whole();
  const vtkIdType cells = alone[0]->GetNumberOfElements(vtkDataObject::CELL);
  EXPECT_TRUE(cells > 0 && cells < 30) << cells;
  update(mesher);
  EXPECT_EQ(patches()->GetNumberOfPartitionedDataSets(), 6u);
  expectGathered(volume(), alone[0]);
  expectGathered(patches(), alone[1]);
}

TEST_F(OnRanks, QualityIsThatOfOneProcess)
{
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(mesher->GetOutputPort(0));
  quality->SetPatchesConnection(mesher->GetOutputPort(1));
  quality->CheckMeshOn();
  quality->Update();
  vtkNew<vtkUnstructuredGrid> alone;
  alone->DeepCopy(quality->GetOutput());
  vtkNew<vtkTable> summary;
  summary->DeepCopy(quality->GetSummary());
  update(quality);
  expectGathered(quality->GetOutput(), alone);
  for (vtkIdType i = 0; rank() == 0 && i < summary->GetNumberOfColumns(); ++i)
  {
    for (vtkIdType row = 0; row < summary->GetNumberOfRows(); ++row)
    {
      EXPECT_EQ(quality->GetSummary()->GetValue(row, i), summary->GetValue(row, i));
    }
  }
}

TEST_F(OnRanks, FacesOfPiecesAreThoseOfTheMesh)
{
  const auto alone = whole();
  auto* grid = vtkUnstructuredGrid::SafeDownCast(alone[0]);
  const atria::FaceMesh all =
      atria::faceMeshFromVtk(grid, vtkPartitionedDataSetCollection::SafeDownCast(alone[1])).mesh;
  update(mesher);
  const auto piece = atria::MeshPiece::of(volume(), patches(), *controller());
  ASSERT_EQ(piece.has_value(), ranks() > 1); // one has no ghosts, and is measured as ever
  if (piece)
  {
    const auto faces = piece->faces(atria::VtkCells(volume()), atria::SerialExecutor());
    ASSERT_TRUE(faces.has_value());
    EXPECT_EQ(sumOverRanks(static_cast<vtkIdType>(piece->ownFaces(*faces).size())),
              static_cast<vtkIdType>(all.faceCount()));
  }
}

TEST_F(OnRanks, QualityIsMeasuredWherePiecesAre)
{
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(mesher->GetOutputPort(0));
  for (const bool withPatches : {true, false})
  {
    if (withPatches)
    {
      quality->SetPatchesConnection(mesher->GetOutputPort(1));
    }
    else
    {
      quality->SetInputConnection(1, nullptr);
    }
    quality->UpdatePiece(0, 1, 0);
    vtkNew<vtkUnstructuredGrid> alone;
    alone->DeepCopy(quality->GetOutput());
    vtkNew<vtkTable> summary;
    summary->DeepCopy(quality->GetSummary());
    const vtkIdType invalid = quality->GetNumberOfInvalidCells();
    update(quality);
    EXPECT_EQ(quality->GetNumberOfInvalidCells(), invalid);
    expectNear(quality->GetOutput(), alone);
    if (rank() == 0)
    {
      expectNear(quality->GetSummary(), summary);
    }
    else
    {
      EXPECT_EQ(quality->GetSummary()->GetNumberOfRows(), 0);
    }
    mesher->SetInputDataObject(atria::testing::toPolyData(scene())); // again everywhere
    hasNothing = false;
  }
}

TEST_F(OnRanks, TheImprovedMeshIsThatOfOneProcess)
{
  vtkNew<vtkAtriaMeshOptimizer> optimizer;
  optimizer->SetInputConnection(mesher->GetOutputPort(0));
  optimizer->SetPatchesConnection(mesher->GetOutputPort(1));
  optimizer->SetNumberOfSweeps(1);
  optimizer->Update();
  vtkNew<vtkUnstructuredGrid> alone;
  alone->DeepCopy(optimizer->GetOutput());
  update(optimizer);
  EXPECT_GT(optimizer->GetOutput()->GetNumberOfCells(), 0);
  expectGathered(optimizer->GetOutput(), alone);
}

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

TEST_F(OnRanks, AnErrorIsToldOnceAndEmptiesAll)
{
  update(mesher);
  ASSERT_GT(volume()->GetNumberOfCells(), 0);
  mesher->SetSizeMin(-1.0);
  update(mesher);
  expectEmpty();
  const auto errors = messages.takeErrors();
  if (rank() == 0)
  {
    EXPECT_THAT(atria::testing::firstOf(errors), HasSubstr("SizeMin"));
  }
  mesher->SetSizeMin(0.5);
  update(mesher);
  EXPECT_GT(volume()->GetNumberOfCells(), 0);
}

} // namespace

int main(int argc, char** argv)
{
  vtkNew<vtkMPIController> mpi;
  mpi->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(mpi);
  ::testing::InitGoogleMock(&argc, argv);
  if (rank() > 0) // failures are told all the same
  {
    ::testing::GTEST_FLAG(brief) = true;
  }
  const int own = RUN_ALL_TESTS();
  const auto failed = static_cast<int>(greatestOverRanks(own));
  vtkMultiProcessController::SetGlobalController(nullptr);
  mpi->Finalize();
  return failed;
}
