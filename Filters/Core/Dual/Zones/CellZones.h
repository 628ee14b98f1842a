// SPDX-License-Identifier: GPL-3.0-or-later
/// What closed surfaces enclose that are no walls.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Grid/GridPlaces.h"

#include <span>

namespace atria {

/// Of grid points that are in no cell zone.
inline constexpr std::int32_t noCellZone = -1;

/// Per grid point the surface of kind SurfaceKind::cellZone that encloses it, the first if there are several, or
/// noCellZone; empty where no surface is of that kind. Throws Error for a surface that is not closed.
std::vector<std::int32_t> findCellZones(const Crossings& crossings, const GridPlaces& grid, const SurfaceModel& model,
                                        const RunContext& context);

/// A warning for each cell zone of the model that none of `zones`, by element, names.
std::vector<std::string> warningsOfEmptyCellZones(std::span<const std::int32_t> zones, const SurfaceModel& model);

} // namespace atria
