// SPDX-License-Identifier: GPL-3.0-or-later
/// A part of a mesh as a mesh by its faces, to see what a writer makes of it.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Quality/Faces/FaceMesh.h"

namespace atria {

struct PartialMesh
{
  FaceMesh mesh;
  std::vector<Index> patchOf; ///< as for mergeCoplanarFaces()
};

/// The elements given are the first cells, in this order; those beside them follow. Faces to elements that are not
/// there are on the boundary, each in a patch of its own. Those to elements that are `leftOut`, in order, are of the
/// patch that wallsOf() says.
PartialMesh makePartialMesh(const DualMesh& mesh, const std::vector<Index>& elements,
                            const std::vector<Index>& leftOut = {});

/// The largest of an element's boundary faces that are on no side of the domain, or of all where there are none;
/// noIndex where it has none.
Index wallOf(const DualMesh& mesh, Index element);

/// For each of some elements, in order, that are left out: the boundary face of whose surface the mesh's boundary is
/// then. That is wallOf() the element, or of the nearest of these from face to face; one on a side of the domain only
/// where no other is. noIndex where none is at a wall.
std::vector<Index> wallsOf(const DualMesh& mesh, const std::vector<Index>& elements);

} // namespace atria
