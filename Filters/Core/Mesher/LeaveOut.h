// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes elements out of a finished mesh.
#pragma once

#include "Mesher/DualImprover.h"

namespace atria {

/// Takes elements, in order, out of a mesh with all that belongs to them. Faces between them and others are boundary
/// faces then, of the surface that wallsOf() tells, which there is for each. Elements, faces and points keep their
/// order.
/// `mesh.numbers`, `mesh.pointNumbers` and `mesh.leftOut` tell of it.
void leaveOut(const std::vector<Index>& elements, ImprovedMesh& mesh);

} // namespace atria
