// SPDX-License-Identifier: GPL-3.0-or-later
/// Improves hexahedra where sizes change.
#pragma once

#include "Mesher/Blocks/ClassifiedMesh.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// Moves vertices at elements where sizes change, until the hexahedra there have a scaled Jacobian of 0.5 or no vertex
/// finds a better place. `mesh` is the plain dual of an octree (makeHexahedral).
void improveTransitions(ClassifiedMesh& mesh, const MeshingContext& context);

} // namespace atria
