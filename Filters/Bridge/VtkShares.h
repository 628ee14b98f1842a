// SPDX-License-Identifier: GPL-3.0-or-later
/// A mesh and its patches divided among ranks.
#pragma once

#include "Support/Executor.h"
#include "Support/Types.h"
#include "VtkArrays.h"
#include "VtkSubset.h"

#include <cstddef>
#include <vector>

class vtkPartitionedDataSetCollection;
class vtkUnstructuredGrid;

namespace atria {

/// The rank of each cell: ranges of equal length, within one cell, along the Morton order of the cells.
std::vector<Index> divideCells(vtkUnstructuredGrid* whole, std::size_t ranks, const Executor& executor);

/// Makes the pieces of all ranks, one after the other, so that no two of them need be there at once.
class MeshShares
{
public:
  /// `rankOfCells` has an entry for each cell of `mesh`, which must outlive this, unchanged.
  MeshShares(vtkUnstructuredGrid* mesh, std::vector<Index> rankOfCells, std::size_t ranks, int ghostLevels);

  /// The rank's cells and, around them, rings of cells that share a point with those before, one a ghost level. Cells
  /// and points keep their order. Their numbers in the whole are their global ids (GlobalCellIds, GlobalPointIds),
  /// where it has none. What is another rank's is marked in vtkGhostType; a point is that of the first rank that has a
  /// cell at it. Field data is the whole's.
  vtkSmartPointer<vtkUnstructuredGrid> mesh(std::size_t rank);

  /// All patches of the mesh, with those of their faces whose owners are the rank's own cells; what has no owners is
  /// the first rank's. Ids of cells and points in their arrays stay those of the whole. Faces and points have global
  /// ids, which go on from patch to patch.
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches(vtkPartitionedDataSetCollection* all,
                                                           std::size_t rank) const;

private:
  std::vector<Index> cellsOf(std::size_t rank, std::vector<char>& hasPoint) const;
  void markGhosts(vtkUnstructuredGrid* piece, const VtkIds& cells, const VtkIds& points, std::size_t rank) const;

  template <typename F> void forPoints(Index cell, F&& body) const;

  vtkUnstructuredGrid* whole;
  VtkCells cells;
  std::vector<Index> rankOf;
  int levels;
  std::vector<Index> rankOfPoint;
  std::vector<std::vector<Index>> own; ///< by rank, in rising order
  std::vector<Index> atBorders;        ///< cells with a point that has cells of other ranks
  VtkIds newPoint;
};

} // namespace atria
