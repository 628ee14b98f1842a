// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells whose quality is known without measuring it.
#pragma once

#include "Quality/Faces/FaceMesh.h"

#include <vector>

namespace atria {

/// A cell is a regular box if it is a hexahedron along the axes, to the last bit of its coordinates, and so are the
/// eight cells at each of its corners. All cells across its faces are boxes then, so that it is ideal in all that
/// depends on directions. A regular box is told apart from the others, which have to be measured, without finding
/// faces: from the corners alone. Cells may not overlap.
struct RegularBoxes
{
  /// Per cell.
  Buffer<char> isRegular;
  /// Per regular box, with no values for other cells: volume, and diagonal over shortest edge, its aspect ratio.
  Buffer<double> volumes;
  Buffer<double> aspectRatios;
  /// Per point: whether a cell that is not regular has it.
  Buffer<char> isTouched;
  /// In rising order: cells that are not regular, and those that are and may have a face in common with them, a face
  /// all of whose points are touched.
  std::vector<Index> measured;
  /// Faces between regular boxes that are not all touched: whether cells that are measured have them or not, they need
  /// not be.
  std::size_t idealFaces = 0;
};

/// Cells at the `apart` points are not regular. What is wrong with the cells is not told: those that are wrong are to
/// be measured. The result does not depend on threads. O(cells).
RegularBoxes findRegularBoxes(std::span<const Vec3> points, const CellArrays& cells,
                              std::span<const std::int64_t> apart, const Executor& executor);

} // namespace atria
