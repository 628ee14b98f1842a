// SPDX-License-Identifier: GPL-3.0-or-later
/// Zones that reach over several ranks.
#pragma once

#include "Dual/Displacement/ZonesApart.h"
#include "Dual/Zones/ZoneEnclosures.h"
#include "Mesher/Shares/RankShare.h"

namespace atria {

/// The zones of the whole, numbered as findZones does. Of the points of a rank's octree those that are not the whole's
/// are of a zone more, the last one, which `sizes` and sides do not count. Every rank joins what it has, and all join
/// the sets of all: borders are sent once, and a few numbers for each set. Throws Error where ranks do not have the
/// same points.
Zones findSharedZones(const Crossings& crossings, const SharedPoints& points, std::size_t surfaceCount,
                      const RankShare& share, const RunContext& context);

/// As wideZones, of the whole.
std::vector<Index> sharedWideZones(const GridPoints& grid, const Crossings& crossings, const SharedPoints& points,
                                   std::size_t surfaceCount, const RankShare& share, const RunContext& context);

/// As chooseZones; the last zone, which findSharedZones adds, has no entry.
std::vector<char> keptSharedZones(const Zones& zones, ZoneRule rule, const std::vector<Vec3>& seeds,
                                  const GridPlaces& grid, const SharedPoints& points, const RankShare& share,
                                  const SurfaceModel& model, const ZoneFacts& facts, const ZoneEnclosures& enclosures);

/// Whether the zone of one of these seeds is leaking (isLeaking); on all ranks.
bool isAnyLeaking(const std::vector<Vec3>& sealedSeeds, const Zones& zones, const GridPlaces& grid,
                  const RankShare& share, const SurfaceModel& model);

} // namespace atria
