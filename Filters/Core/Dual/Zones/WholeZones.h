// SPDX-License-Identifier: GPL-3.0-or-later
/// Keeps and lists the zones of a mesh like those of the whole model, of which parts were left aside.
#pragma once

#include "Dual/Zones/ModelViews.h"

namespace atria {

/// Zones of the octree's own grid, which has all of the model. Solids that lie in each other, and rooms below the
/// ground, are distinguished there.
struct WholeZones
{
  std::vector<std::int32_t> ofPoint;
  std::vector<char> kept;
  std::vector<ZoneSummary> summaries;
};

/// Keeps each zone of the displaced grid if most of its points that were not moved are in zones that the whole keeps. A
/// zone without such points stays as it is. Returns one entry per zone: the zone of the whole in which most of these
/// points are; -1 for zones without any.
std::vector<std::int32_t> keepAs(const WholeZones& whole, const Zones& zones, const GridPlaces& grid,
                                 const GridPart& part, std::vector<char>& kept, std::vector<ZoneSummary>& summaries);

/// Lists the zones as the whole has them, except that kept zones are described as they are now. Kept zones that the
/// whole does not keep follow. `ofWhole` is from keepAs(); `ofElement` gets the numbers in that list.
void listAs(const WholeZones& whole, const std::vector<std::int32_t>& ofWhole, Buffer<std::int32_t>& ofElement,
            std::vector<char>& kept, std::vector<ZoneSummary>& summaries);

} // namespace atria
