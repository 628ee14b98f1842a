// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the grid points that closed surfaces of kind `cellZone` enclose.
#pragma once

#include "Dual/Grid/GridPart.h"
#include "Dual/Zones/SurfaceDepths.h"
#include "Support/RunContext.h"

#include <span>

namespace atria {

/// Value for grid points that are in no cell zone.
inline constexpr std::int32_t noCellZone = -1;

/// Returns the surfaces of kind SurfaceKind::cellZone.
std::vector<Index> cellZonesOf(const SurfaceModel& model);

/// Returns one entry per grid point: the surface of kind SurfaceKind::cellZone that encloses it, the first if there are
/// several, or noCellZone. Empty if no surface is of that kind. Throws Error for a surface that is not closed.
std::vector<std::int32_t> findCellZones(const Crossings& crossings, const GridPlaces& grid, const GridPart& part,
                                        const SurfaceModel& model, const RunContext& context);

/// Returns a warning for each cell zone of the model that holds no element. `isMet` has one entry per surface.
std::vector<std::string> warningsOfEmptyCellZones(const std::vector<char>& isMet, const SurfaceModel& model);

/// Marks the surfaces that occur in `zones`, which has one entry per element.
std::vector<char> metCellZones(std::span<const std::int32_t> zones, const SurfaceModel& model);

} // namespace atria
