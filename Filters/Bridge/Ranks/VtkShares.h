// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides a mesh and its patches among ranks.
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

/// Returns the rank of each cell: ranges along the Morton order of the cells, equal in length to within one cell.
std::vector<Index> divideCells(vtkUnstructuredGrid* whole, std::size_t ranks, const Executor& executor);

/// Makes the pieces of all ranks one after the other, so that only one needs to exist at a time.
class MeshShares
{
public:
  /// `rankOfCells` has an entry for each cell of `mesh`, which must outlive this, unchanged.
  MeshShares(vtkUnstructuredGrid* mesh, std::vector<Index> rankOfCells, std::size_t ranks, int ghostLevels);

  /// Returns the rank's cells and rings of cells around them that share a point with the cells before, one ring per
  /// ghost level. Cells and points keep their order. Their numbers in the whole mesh become global ids (GlobalCellIds,
  /// GlobalPointIds) if it has none. vtkGhostType marks cells and points of other ranks; a point belongs to the first
  /// rank that has a cell at it. Field data is that of the whole mesh.
  vtkSmartPointer<vtkUnstructuredGrid> mesh(std::size_t rank);

  /// Returns all patches of the mesh, each with the faces whose owners are the rank's own cells; faces without owners
  /// belong to the first rank. Cell and point ids in their arrays stay those of the whole mesh. Faces and points have
  /// global ids, which continue from patch to patch.
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
  std::vector<std::vector<Index>> own; ///< one list per rank, in rising order
  std::vector<Index> atBorders;        ///< cells with a point that has cells of other ranks
  VtkIds newPoint;
};

} // namespace atria
