// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds displaced grid points through which zones would meet that are to stay apart.
#pragma once

#include "Dual/Grid/Crossings.h"

#include <functional>

namespace atria {

/// Returns a zone number per grid point. It is noIndex in zones so thin that surfaces cut the octants around all of
/// their points, such as the pieces in which a coarse grid sees the space between two walls.
std::vector<Index> wideZones(const GridPoints& points, const Crossings& crossings, const RunContext& context);

/// Another way to find these; it returns `zoneElsewhere` for points of which nothing is known.
using WideZoneFinder = std::function<std::vector<Index>(const GridPoints& points, const Crossings& crossings)>;
inline constexpr Index zoneElsewhere = noIndex - 1;

/// Marks the grid points around which surfaces cut no octant.
std::vector<char> pointsInTheOpen(const GridPoints& points, const Crossings& crossings, const RunContext& context);

/// Returns the moved points through which separate zones meet, sorted. `zones` are those of the octree's own grid,
/// `crossings` those of the moved one.
std::vector<Index> joiningPoints(const GridPlaces& grid, const Crossings& crossings, const std::vector<Index>& zones);

} // namespace atria
