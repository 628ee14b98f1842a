// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the dual of an octree all hexahedral where sizes change.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Dual/Vertices/DualVertices.h"

namespace atria {

/// Replaces the elements where sizes change by hexahedra: splits the octants there (SplitOctants) and takes the dual of
/// what comes of that. `mesh` is the dual of `octree` without copies or layers; its vertex v is that of leaf
/// `classification.leaves[v]`. New vertices and elements come after all others; new faces are on bare sides of the
/// domain. Vertices of split octants move to the middles of their parts.
///
/// Split octants must not touch octants that hold a surface (makeUniformAtWalls); throws Error if they do, with the
/// place.
void makeHexahedral(DualMesh& mesh, VertexClassification& classification, const Octree& octree,
                    std::size_t surfaceCount, const RunContext& context);

} // namespace atria
