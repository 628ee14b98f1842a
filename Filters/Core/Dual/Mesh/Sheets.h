// SPDX-License-Identifier: GPL-3.0-or-later
/// Splits the points of sheets so that their two sides share none.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Support/RunContext.h"

namespace atria {

/// Gives each side of a sheet points of its own. The elements around a point on the boundary fall into sectors,
/// connected through faces that are not on the boundary; each sector gets its own copy of the point. A boundary edge
/// has one sector, the inside of a sheet two, a T-junction three. New points follow the old ones, by point and then by
/// sector (that of the first element keeps the original). Returns the original of each new point. O(boundary).
std::vector<Index> splitSheets(DualMesh& mesh, const RunContext& context);

} // namespace atria
