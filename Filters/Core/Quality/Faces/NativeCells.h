// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides polyhedra into pyramids and tetrahedra, for formats without polyhedra.
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Support/Progress.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace atria {

/// Tetrahedra, hexahedra, wedges and pyramids in VTK's numbering.
struct NativeCells
{
  std::vector<unsigned char> types;
  std::vector<std::size_t> offsets{0}; ///< types.size() + 1
  std::vector<Index> corners;
  std::vector<Vec3> apices;         ///< new points, numbered after those of the mesh
  std::size_t invertedCells = 0;    ///< number of inverted parts of polyhedra
  std::size_t dividedPolyhedra = 0; ///< number of polyhedra that were divided

  std::span<const Index> cornersOf(std::size_t cell) const
  {
    return {corners.data() + offsets[cell], corners.data() + offsets[cell + 1]};
  }
};

/// Calls `put` with a face of three or four corners as it is, and with the triangles of a larger face. These are a fan
/// from the lowest-numbered corner whose triangles all point to the face's side, or from the lowest corner if there is
/// none. The result is the same for both cells of a face, in either orientation.
void divideFace(std::span<const Vec3> points, std::span<const Index> face,
                const std::function<void(std::span<const Index>)>& put);

/// Divides polyhedra and turns voxels into hexahedra. `mesh` has the faces of `cells`, `cellFaces` those of each cell;
/// `newPoint` maps points of `cells` to points of `mesh`, empty if they are the same. A polyhedron becomes pyramids
/// over quadrilaterals and tetrahedra over triangles of its faces, divided by divideFace(), with a common apex: the
/// cell's centroid if it sees all of them, else a position near it that does, else the centroid. The parts of a
/// polyhedron take its place. The result is conformal if the mesh is. Throws Aborted when asked to.
NativeCells makeNativeCells(const FaceMesh& mesh, const CellFaces& cellFaces, const CellArrays& cells,
                            std::span<const Index> newPoint, const ProgressRange& progress);

} // namespace atria
