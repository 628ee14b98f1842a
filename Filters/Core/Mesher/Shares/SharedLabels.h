// SPDX-License-Identifier: GPL-3.0-or-later
/// Face zones, rooms and cell zones that reach over several ranks.
#pragma once

#include "Dual/Displacement/DisplacedGrid.h"
#include "Dual/Zones/Labels.h"
#include "Mesher/Shares/RankShare.h"

namespace atria {

/// What findZoneFaces, findRooms and findCellZones find in the whole, of the points of a rank's octree; those that are
/// not the whole's are in no room and no cell zone. All ranks call it at the same time. Throws as these.
Labels findSharedLabels(const Zones& zones, const std::vector<ZoneSummary>& summaries, const DisplacedGrid& grid,
                        const SharedPoints& points, const RoomOptions& options, const RankShare& share,
                        const MeshingContext& context);

} // namespace atria
