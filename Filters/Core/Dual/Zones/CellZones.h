// SPDX-License-Identifier: GPL-3.0-or-later
/// What closed surfaces enclose that are no walls.
#pragma once

#include "Dual/Zones/SurfaceDepths.h"
#include "Support/RunContext.h"

#include <span>

namespace atria {

/// Of grid points that are in no cell zone.
inline constexpr std::int32_t noCellZone = -1;

/// The surfaces of kind SurfaceKind::cellZone.
std::vector<Index> cellZonesOf(const SurfaceModel& model);

/// Per grid point the surface of kind SurfaceKind::cellZone that encloses it, the first if there are several, or
/// noCellZone; empty where no surface is of that kind. Throws Error for a surface that is not closed.
std::vector<std::int32_t> findCellZones(const Crossings& crossings, const GridPlaces& grid, const SurfaceModel& model,
                                        const RunContext& context);

/// Gives the points that a surface encloses its number, unless they have one; `zoneOf` is by point from `first` on,
/// `outside` by part the depth of what is not enclosed. Returns whether there are any.
bool fillCellZone(Index surface, const SurfaceDepths& depths, std::span<const int> outside, Index first,
                  std::vector<std::int32_t>& zoneOf);

/// Throws Error for a surface that is not closed.
[[noreturn]] void failOpenCellZone(const std::string& surface);

/// A warning for each cell zone of the model that holds no element; `isMet` is by surface.
std::vector<std::string> warningsOfEmptyCellZones(const std::vector<char>& isMet, const SurfaceModel& model);

/// By surface whether any of `zones`, by element, names it.
std::vector<char> metCellZones(std::span<const std::int32_t> zones, const SurfaceModel& model);

} // namespace atria
