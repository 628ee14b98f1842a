// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests on MPI ranks: started by mpiexec, every rank runs every test.
#pragma once

#include "DualMesherTest.h"

#include <vtkIdTypeArray.h>
#include <vtkMultiProcessController.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <array>
#include <set>

namespace atria::testing {

vtkMultiProcessController* controller();
int rank();
int ranks();
vtkIdType sumOverRanks(vtkIdType own);
vtkIdType greatestOverRanks(vtkIdType own);

/// The pieces of all ranks as one, on the first; null on others.
vtkSmartPointer<vtkDataObject> gathered(vtkDataObject* piece);
void expectGathered(vtkDataObject* piece, vtkDataObject* whole);

/// Solids, a sheet with two sides, and a curved wall.
TriangleSurface sceneOnRanks();

class OnRanks : public DualMesherTest
{
protected:
  OnRanks();

  /// What one process makes, here on each rank by itself.
  std::array<vtkSmartPointer<vtkDataObject>, 3> whole() { return copiesOfOutputs(); }

  /// That the outputs of all ranks are a mesh that one process has made, with its diagnostics on the first.
  void expectPiecesOf(const std::array<vtkSmartPointer<vtkDataObject>, 3>& alone)
  {
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

  /// The first rank has the model.
  void update(vtkAlgorithm* algorithm, int ghostLevels = 0);
  /// Gives every rank the model again.
  void setSceneEverywhere();

  static vtkIdTypeArray* idsOfCells(vtkDataSet* piece);
  static vtkIdTypeArray* idsOfPoints(vtkDataSet* piece);
  /// Global ids of the rank's own cells.
  std::set<vtkIdType> ownCells();

private:
  bool hasNothing = false;
};

} // namespace atria::testing
