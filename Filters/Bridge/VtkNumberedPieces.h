// SPDX-License-Identifier: GPL-3.0-or-later
/// Pieces whose cells and points have global ids, put together so that the whole has the same bits however it was
/// divided.
#pragma once

#include "Support/Types.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkDataSet;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria {

/// Whether cells and points have global ids: the attributes, or arrays GlobalCellIds and GlobalPointIds.
bool isNumbered(vtkDataSet* piece);

/// Whether a numbered grid is what stands in several pieces, one after the other, as readers of .pvtu files give them:
/// it has ghost cells, or points of the same id.
bool isInPieces(vtkUnstructuredGrid* grid);

struct NumberedWhole
{
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  std::vector<Index> pieceOf; ///< for each cell of the grid the piece that it is of
};

/// Cells and points in the order of their ids, and arrays that all pieces have. Leaves out ghosts, points that have no
/// other cells, the array vtkGhostType, and ids without gaps, as they are what the order tells. Field data is that of
/// the first piece. Throws Error where two pieces have a cell of the same id. \pre All pieces are numbered, and there
/// is at least one.
NumberedWhole joinNumberedGrids(const std::vector<vtkUnstructuredGrid*>& pieces);

/// The same of polygons.
vtkSmartPointer<vtkPolyData> joinNumberedSurfaces(const std::vector<vtkPolyData*>& pieces);

} // namespace atria
