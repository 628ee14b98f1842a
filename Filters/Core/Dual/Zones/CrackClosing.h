// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// Closes cracks no wider than `tolerance` times the octants there: edges of the grid that pass through their strips
/// (crackStrips) and that nothing cuts are cut by the triangle beside the boundary edge. Nothing is done at tolerance
/// 0. Exact as all crossings are, so that edges round a place agree. Cost: that of the boundary edges. The result does
/// not depend on threads.
Crossings closeCracks(Crossings crossings, const GridPlaces& grid, double tolerance, const MeshingContext& context);

} // namespace atria
