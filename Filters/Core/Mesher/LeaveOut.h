// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes elements out of a finished mesh.
#pragma once

#include "Mesher/DualImprover.h"

namespace atria {

/// Takes elements, which are sorted, and all that belongs to them out of a mesh. Faces between them and other elements
/// become boundary faces, on the surface that wallsOf() returns; it must return one for each element. Elements, faces
/// and points keep their order. Records the change in `mesh.numbers`, `mesh.pointNumbers` and `mesh.leftOut`.
void leaveOut(const std::vector<Index>& elements, ImprovedMesh& mesh);

} // namespace atria
