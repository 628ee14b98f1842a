// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Grid/Crossings.h"

#include <functional>

namespace atria {

/// Per grid point, a number of its zone; noIndex in zones so thin that surfaces cut the octants about all of their
/// points, as the pieces are in which the space between two walls is seen by a coarse grid.
std::vector<Index> wideZones(const GridPoints& points, const Crossings& crossings, const RunContext& context);

/// Another way to find these, which has `zoneElsewhere` for points of which nothing is to be known.
using WideZoneFinder = std::function<std::vector<Index>(const GridPoints& points, const Crossings& crossings)>;
inline constexpr Index zoneElsewhere = noIndex - 1;

/// Per grid point, whether surfaces cut none of the octants about it.
std::vector<char> pointsInTheOpen(const GridPoints& points, const Crossings& crossings, const RunContext& context);

/// Moved points through which zones meet that are apart: `zones` are those of the octree's own grid, `crossings` of the
/// moved one. Sorted.
std::vector<Index> joiningPoints(const GridPlaces& grid, const Crossings& crossings, const std::vector<Index>& zones);

} // namespace atria
