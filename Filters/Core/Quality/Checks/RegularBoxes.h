// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells whose quality is known without measuring it.
#pragma once

#include "Quality/Faces/FaceMesh.h"

#include <vector>

namespace atria {

/// A cell is a regular box if it is a hexahedron along the axes, to the last bit of its coordinates, and so are the
/// eight cells at each of its corners. All cells across its faces are then boxes, so all its metrics that depend on
/// directions are ideal. Regular boxes are found from the corners alone, without finding faces; other cells have to be
/// measured. Cells must not overlap.
struct RegularBoxes
{
  /// One entry per cell.
  Buffer<char> isRegular;
  /// One entry per cell, unset for cells that are no boxes: volume, and aspect ratio (diagonal over shortest edge).
  Buffer<double> volumes;
  Buffer<double> aspectRatios;
  /// One entry per point: 1 if a cell that is not regular has it.
  Buffer<char> isTouched;
  /// Cells that must be measured, in rising order: cells that are not regular, and regular ones with a face whose
  /// points are all touched, which may be shared with them.
  std::vector<Index> measured;
  /// Number of faces between regular boxes with a point that is not touched. They need not be measured, even if
  /// measured cells have them.
  std::size_t idealFaces = 0;
};

/// Finds the regular boxes of a mesh. Cells at the `apart` points are not regular. Errors in cells are not reported;
/// wrong cells are among the measured ones. The result does not depend on the number of threads. O(cells).
RegularBoxes findRegularBoxes(std::span<const Vec3> points, const CellArrays& cells,
                              std::span<const std::int64_t> apart, const Executor& executor);

} // namespace atria
