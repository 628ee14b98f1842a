// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds elements that are concave at walls wherever their other points are.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Support/RunContext.h"

#include <vector>

namespace atria {

/// Returns the elements, sorted, that checkMesh calls concave because of their boundary faces alone: one of two faces
/// is behind the plane of the other, or in it. Faces in one plane are merged first where that is possible
/// (mergeCoplanarFaces). O(n log n) in boundary faces. The result is the same for any number of threads.
std::vector<Index> findConcaveAtWalls(const DualMesh& mesh, const RunContext& context);

} // namespace atria
