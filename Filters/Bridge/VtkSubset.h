// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of VTK's data objects, cell by cell and point by point, and such parts put together again.
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

/// The name is null for arrays that need none.
vtkSmartPointer<vtkIdTypeArray> idArray(const char* name, std::span<const vtkIdType> ids);

/// Adds what `from` has for `ids`, in their order, and makes attributes what they are there.
void takeTuples(vtkDataSetAttributes* from, const VtkIds& ids, vtkDataSetAttributes* to);

/// Of the same precision.
vtkSmartPointer<vtkPoints> takePoints(vtkPoints* from, const VtkIds& ids);

/// Makes cells one after the other, with new numbers for points.
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
  /// Of polyhedra, one after the other: per cell how many, per face how many points, and these.
  VtkIds faceCounts;
  VtkIds faceSizes;
  VtkIds facePoints;
};

/// A grid without its ghost and hidden cells, and without points that these alone have; itself if it has none.
/// VTK 9.1's RemoveGhostCells takes the points of polyhedra for their faces.
vtkSmartPointer<vtkUnstructuredGrid> withoutGhostCells(vtkUnstructuredGrid* grid);

/// Whether cells have ids of 32 bits.
bool isNarrow(vtkCellArray* cells);

/// Cells of the points given, with 32-bit numbers if `narrow` and they suffice.
vtkSmartPointer<vtkCellArray> cellArray(const VtkIds& offsets, const VtkIds& connectivity, bool narrow);

} // namespace atria
