// SPDX-License-Identifier: GPL-3.0-or-later
/// Elements that are concave at walls wherever their other points are.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Support/RunContext.h"

#include <vector>

namespace atria {

/// The elements, in order, of which two boundary faces look at each other from behind or from within one plane, as
/// checkMesh tells concave cells, once faces in one plane are made one where that is possible (mergeCoplanarFaces).
/// O(n log n) in boundary faces. The same for any number of threads.
std::vector<Index> findConcaveAtWalls(const DualMesh& mesh, const RunContext& context);

} // namespace atria
