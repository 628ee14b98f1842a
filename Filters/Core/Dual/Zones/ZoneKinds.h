// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Zones/Zones.h"

namespace atria {

/// Fills in volume and kind of the zones. Both are from grid points: the volume is that of the octants, shared out
/// among their corners, and so right to about half an octant at the border.
void describeZones(std::vector<ZoneSummary>& summaries, const Zones& zones, const Crossings& crossings,
                   const GridPlaces& grid, std::size_t surfaceCount, const RunContext& context);

} // namespace atria
