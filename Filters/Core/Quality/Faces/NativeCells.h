// SPDX-License-Identifier: GPL-3.0-or-later
/// Polyhedra cut into pyramids and tetrahedra, for formats that know no others.
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
  std::vector<Vec3> apices;         ///< points behind those of the mesh
  std::size_t invertedCells = 0;    ///< parts of polyhedra that are inside out
  std::size_t dividedPolyhedra = 0; ///< how many polyhedra there were

  std::span<const Index> cornersOf(std::size_t cell) const
  {
    return {corners.data() + offsets[cell], corners.data() + offsets[cell + 1]};
  }
};

/// Calls `put` with a face of three or four corners as it is, and with the triangles of one that has more: a fan from
/// the corner of the lowest number all of whose triangles look to the face's side, from the lowest of all where there
/// is none. The same for both cells of a face, whichever way round its corners are given.
void divideFace(std::span<const Vec3> points, std::span<const Index> face,
                const std::function<void(std::span<const Index>)>& put);

/// `mesh` are the faces of `cells`, `cellFaces` those of each; `newPoint` has for each point of `cells` the one of
/// `mesh`, empty where these are the same. Voxels become hexahedra, polyhedra pyramids over quadrilaterals and
/// tetrahedra over triangles of their faces, divided by divideFace(), about an apex: the cell's centroid where it sees
/// all of them, else a place near it that does where one is found, else the centroid. Parts of a polyhedron stand in
/// its place. The result is conformal as the mesh is. Throws Aborted when asked to.
NativeCells makeNativeCells(const FaceMesh& mesh, const CellFaces& cellFaces, const CellArrays& cells,
                            std::span<const Index> newPoint, const ProgressRange& progress);

} // namespace atria
