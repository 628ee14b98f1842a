// SPDX-License-Identifier: GPL-3.0-or-later
/// Joins pieces whose cells and points have global ids. The whole has the same bits however it was divided.
#pragma once

#include "Support/Types.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkDataSet;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace atria {

/// True if cells and points have global ids: the attributes, or arrays GlobalCellIds and GlobalPointIds.
bool isNumbered(vtkDataSet* piece);

/// True if a numbered grid consists of several pieces, one after the other, as readers of .pvtu files return them: it
/// has ghost cells, or points with the same id.
bool isInPieces(vtkUnstructuredGrid* grid);

struct NumberedWhole
{
  vtkSmartPointer<vtkUnstructuredGrid> grid;
  std::vector<Index> pieceOf; ///< one entry per cell of the grid: its piece
};

/// Joins grids: cells and points in the order of their ids, and arrays that all pieces have. Omits ghosts, points of
/// ghosts only, the array vtkGhostType, and ids without gaps, as the order implies them. Field data is that of the
/// first piece. Throws Error if two pieces have a cell with the same id. \pre All pieces are numbered, and there is at
/// least one.
NumberedWhole joinNumberedGrids(const std::vector<vtkUnstructuredGrid*>& pieces);

/// The same for polygons.
vtkSmartPointer<vtkPolyData> joinNumberedSurfaces(const std::vector<vtkPolyData*>& pieces);

} // namespace atria
