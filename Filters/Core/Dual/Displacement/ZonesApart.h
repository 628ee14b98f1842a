// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds displaced grid points through which zones would meet that are to stay apart.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Grid/GridPart.h"

namespace atria {

/// Zone of points that a process does not know.
inline constexpr Index zoneElsewhere = noIndex - 1;

/// Returns a zone number per grid point. It is noIndex in zones so thin that surfaces cut the octants around all of
/// their points, such as the pieces in which a coarse grid sees the space between two walls.
std::vector<Index> wideZones(const GridPoints& points, const Crossings& crossings, std::size_t surfaceCount,
                             const GridPart& part, const RunContext& context);

/// Returns the moved points through which separate zones meet, sorted. `zones` are those of the octree's own grid,
/// `crossings` those of the moved one.
std::vector<Index> joiningPoints(const GridPlaces& grid, const Crossings& crossings, const std::vector<Index>& zones);

} // namespace atria
