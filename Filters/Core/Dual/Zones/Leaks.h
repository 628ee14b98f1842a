// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the ways by which the zones of sealed seeds leak to the outside.
#pragma once

#include "Dual/Zones/ZoneReport.h"
#include "Dual/Zones/Zones.h"

namespace atria {

/// Returns for each seed whose zone is leaking the widest way to an open side: the way whose narrowest edge is as far
/// from surfaces as possible (maximum capacity path; Pollack 1960). Throws Error for a seed outside the domain, and
/// WholeNeeded if a zone is leaking and this process owns only a part of the grid. Cost of a leak: O(n log n) in the
/// points of its zone.
std::vector<Leak> findLeaks(const std::vector<Vec3>& sealedSeeds, const Zones& zones, const Crossings& crossings,
                            const GridPlaces& grid, const GridPart& part, const SurfaceModel& model,
                            const RunContext& context);

} // namespace atria
