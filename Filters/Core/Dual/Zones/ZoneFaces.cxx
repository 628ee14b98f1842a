// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/ZoneFaces.h"

#include <algorithm>

namespace atria {

namespace {

/// How often crossings pass a surface along its normal, less those against it.
int senseOf(std::span<const SurfaceCrossing> cuts, Index surface, const SurfaceModel& model)
{
  int sum = 0;
  for (const SurfaceCrossing& cut : cuts)
  {
    sum += model.surfaceIds[cut.triangle] == surface ? cut.orientation : 0;
  }
  return sum;
}

} // namespace

std::vector<ZoneFace> findZoneFaces(const Crossings& crossings, const SurfaceModel& model)
{
  std::vector<ZoneFace> faces;
  if (model.kinds.empty())
  {
    return faces;
  }
  for (const CrossedEdge& edge : crossings.crossedEdges)
  {
    if (edge.other == noIndex || crossings.neighbors[edge.point][edge.direction] < 0)
    {
      continue;
    }
    const auto cuts = crossings.of(edge);
    const auto passes = [&](const SurfaceCrossing& cut) {
      return senseOf(cuts, model.surfaceIds[cut.triangle], model) != 0;
    };
    if (const auto first = std::ranges::find_if(cuts, passes); first != cuts.end())
    {
      const Index surface = model.surfaceIds[first->triangle];
      const bool isAlong = senseOf(cuts, surface, model) > 0;
      faces.push_back({edge.point, surface, edge.direction, isAlong ? SheetSide::back : SheetSide::front});
    }
  }
  return faces;
}

} // namespace atria
