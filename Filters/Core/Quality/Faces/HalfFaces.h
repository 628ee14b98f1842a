// SPDX-License-Identifier: GPL-3.0-or-later
/// Faces as each cell sees them; an internal face is two half-faces.
#pragma once

#include "Quality/Faces/FaceMesh.h"
#include "Support/Buffer.h"

#include <algorithm>
#include <span>

namespace atria {

/// The faces of every cell, cell by cell, each with its normal out of its cell.
struct HalfFaces
{
  Buffer<Index> cellOffsets{0}; ///< cell c has the half-faces cellOffsets[c] .. cellOffsets[c + 1]
  Buffer<Index> offsets{0};     ///< half-face h has the points points[offsets[h]] .. points[offsets[h + 1]]
  Buffer<Index> points;
  Buffer<Index> cell; ///< one entry per half-face

  std::size_t count() const { return cell.size(); }
  std::span<const Index> face(std::size_t h) const
  {
    return {points.data() + offsets[h], points.data() + offsets[h + 1]};
  }
};

/// Returns the faces of all cells. A corner that repeats the one before it is left out of a face, and a face with fewer
/// than three corners left is dropped: a hexahedron with coinciding corners is treated as the shape that it is. Throws
/// Error that names the first cell of an unknown type or with points or faces that do not exist.
HalfFaces takeApart(const CellArrays& cells, std::size_t pointCount, const Executor& executor);

/// Copies the points of a face. Nearly all faces have four points, which are copied without a call.
inline void copyPoints(std::span<const Index> face, Index* to)
{
  if (face.size() == 4)
  {
    std::copy_n(face.data(), 4, to);
  }
  else
  {
    std::copy(face.begin(), face.end(), to);
  }
}

/// True if two polygons have the same points, in any order.
bool samePoints(std::span<const Index> a, std::span<const Index> b);

} // namespace atria
