// SPDX-License-Identifier: GPL-3.0-or-later
/// Extracts a part of a mesh as a face mesh, which is judged as it would be written.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Quality/Faces/FaceMesh.h"

namespace atria {

struct PartialMesh
{
  FaceMesh mesh;
  std::vector<Index> patchOf; ///< as for mergeCoplanarFaces()
};

/// Returns the part with some elements and their neighbors. The elements are the first cells, in this order. Faces to
/// elements outside are on the boundary, each in a patch of its own; faces to elements in `leftOut`, which must be
/// sorted, are in the patch that wallsOf() returns.
PartialMesh makePartialMesh(const DualMesh& mesh, const std::vector<Index>& elements,
                            const std::vector<Index>& leftOut = {});

/// Returns the largest boundary face of an element that is on no side of the domain, else the largest on a side;
/// noIndex if it has no boundary face.
Index wallOf(const DualMesh& mesh, Index element);

/// Returns for each element left out, which must be sorted, the boundary face whose surface takes its place: wallOf()
/// the element, or of the nearest of these elements from face to face. Faces on sides of the domain come last; noIndex
/// if none is at a wall.
std::vector<Index> wallsOf(const DualMesh& mesh, const std::vector<Index>& elements);

} // namespace atria
