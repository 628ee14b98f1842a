// SPDX-License-Identifier: GPL-3.0-or-later
#include "OnRanks.h"

#include "Ranks/Transport.h"
#include "Ranks/VtkPieces.h"

#include <vtkCellData.h>
#include <vtkCommunicator.h>
#include <vtkMPIController.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <gmock/gmock.h>

#include <vector>

namespace atria::testing {

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

vtkSmartPointer<vtkDataObject> gathered(vtkDataObject* piece)
{
  if (rank() > 0)
  {
    sendData(piece, 0, *controller());
    return nullptr;
  }
  std::vector<vtkSmartPointer<vtkDataObject>> pieces{piece};
  for (int other = 1; other < ranks(); ++other)
  {
    pieces.push_back(receiveData(other, *controller()));
  }
  std::erase_if(pieces, [](vtkDataObject* each) { return isEmptyPiece(each); });
  return pieces.empty() ? nullptr : joinPieces(pieces);
}

void expectGathered(vtkDataObject* piece, vtkDataObject* whole)
{
  const auto joined = gathered(piece);
  if (joined && ranks() > 1)
  {
    EXPECT_TRUE(identical(whole, joined));
  }
}

TriangleSurface sceneOnRanks()
{
  TriangleSurface surface;
  addBox(surface, "Building", {Vec3(-1.7, -1.9, 0), Vec3(1.1, 1.4, 2.6)});
  addSheet(surface, "Canopy", Vec3(-1.7, -3.2, 2.1), Vec3(2.8, 0, 0), Vec3(0, 1.3, 0));
  addSphere(surface, "Dome", Vec3(4.1, 1.3, 2.2), 1.4, 2);
  return surface;
}

OnRanks::OnRanks()
{
  setSurface(sceneOnRanks());
  mesher->SetNumberOfLayers(2);
}

void OnRanks::update(vtkAlgorithm* algorithm, int ghostLevels)
{
  if (rank() > 0 && !hasNothing)
  {
    hasNothing = true;
    mesher->SetInputDataObject(vtkNew<vtkPolyData>());
  }
  algorithm->UpdatePiece(rank(), ranks(), ghostLevels);
}

void OnRanks::setSceneEverywhere()
{
  setSurface(sceneOnRanks());
  hasNothing = false;
}

vtkIdTypeArray* OnRanks::idsOfCells(vtkDataSet* piece)
{
  return vtkIdTypeArray::SafeDownCast(piece->GetCellData()->GetGlobalIds());
}

vtkIdTypeArray* OnRanks::idsOfPoints(vtkDataSet* piece)
{
  return vtkIdTypeArray::SafeDownCast(piece->GetPointData()->GetGlobalIds());
}

std::set<vtkIdType> OnRanks::ownCells()
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

} // namespace atria::testing

int main(int argc, char** argv)
{
  vtkNew<vtkMPIController> mpi;
  mpi->Initialize(&argc, &argv);
  vtkMultiProcessController::SetGlobalController(mpi);
  ::testing::InitGoogleMock(&argc, argv);
  if (atria::testing::rank() > 0) // failures are told all the same
  {
    ::testing::GTEST_FLAG(brief) = true;
  }
  const int own = RUN_ALL_TESTS();
  const auto failed = static_cast<int>(atria::testing::greatestOverRanks(own));
  vtkMultiProcessController::SetGlobalController(nullptr);
  mpi->Finalize();
  return failed;
}
