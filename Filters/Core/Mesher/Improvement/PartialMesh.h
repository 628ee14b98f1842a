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
/// there are on the boundary, each in a patch of its own. Those to elements that are `leftOut`, rising, are of the
/// patch that wallOf() says.
PartialMesh makePartialMesh(const DualMesh& mesh, const std::vector<Index>& elements,
                            const std::vector<Index>& leftOut = {});

/// The largest of an element's boundary faces that are on no side of the domain: of its surface is the mesh's boundary
/// where the element is left out. noIndex where there is none.
Index wallOf(const DualMesh& mesh, Index element);

} // namespace atria
