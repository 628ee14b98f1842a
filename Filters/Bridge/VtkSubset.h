// SPDX-License-Identifier: GPL-3.0-or-later
/// Extracts parts of VTK's data objects, cell by cell and point by point, and builds grids from cells.
#pragma once

#include "VtkVersions.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <cstdint>
#include <span>
#include <vector>

class vtkCellArray;
class vtkDataArray;
class vtkDataSetAttributes;
class vtkIdTypeArray;
class vtkPoints;
class vtkUnstructuredGrid;

namespace atria {

using VtkIds = std::vector<vtkIdType>;

/// Returns an array of ids. `name` is null for arrays that need none.
vtkSmartPointer<vtkIdTypeArray> idArray(const char* name, std::span<const vtkIdType> ids);

/// Copies the tuples `ids` of all arrays of `from`, in that order, and sets the same attributes.
void takeTuples(vtkDataSetAttributes* from, const VtkIds& ids, vtkDataSetAttributes* to);

/// Copies points, in the same precision.
vtkSmartPointer<vtkPoints> takePoints(vtkPoints* from, const VtkIds& ids);

/// Builds cells one after the other, with new numbers for points.
class GridBuilder
{
public:
  /// Appends a cell of a grid; `newPoint` has the new number of each of its points.
  void add(vtkUnstructuredGrid* from, vtkIdType cell, std::span<const vtkIdType> newPoint);

  /// Gives `out` the cells that were added, with 32-bit numbers if `narrow` and they suffice.
  void finish(vtkUnstructuredGrid* out, bool narrow);

private:
  FaceLists makeFaces() const;

  vtkNew<vtkIdList> faceStream;
  std::vector<unsigned char> types;
  VtkIds offsets{0};
  VtkIds connectivity;
  /// Polyhedra, one after the other: number of faces per cell, number of points per face, and these points.
  VtkIds faceCounts;
  VtkIds faceSizes;
  VtkIds facePoints;
};

/// Returns a grid without its ghost and hidden cells, and without points that only these have; the grid itself if it
/// has none. VTK 9.1's RemoveGhostCells confuses the points of polyhedra with their faces.
vtkSmartPointer<vtkUnstructuredGrid> withoutGhostCells(vtkUnstructuredGrid* grid);

/// True if the cells have 32-bit ids.
bool isNarrow(vtkCellArray* cells);

/// Returns cells with the given points, with 32-bit numbers if `narrow` and they suffice.
vtkSmartPointer<vtkCellArray> cellArray(const VtkIds& offsets, const VtkIds& connectivity, bool narrow);

} // namespace atria
