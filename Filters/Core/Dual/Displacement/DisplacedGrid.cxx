// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/DisplacedGrid.h"

#include "Dual/Displacement/GapPlanes.h"
#include "Dual/Displacement/PlaceSearch.h"

#include <algorithm>

namespace atria {

namespace {

GridPlaces displacedPlaces(const GridPoints& points, const Crossings& undisplaced, const MeshingContext& context)
{
  GridPlaces places(context.octree, points);
  MovingGrid grid(places, undisplaced, context);
  enterGaps(grid, context);
  searchPlaces(grid, context);
  return places;
}

} // namespace

DisplacedGrid displaceGrid(const GridPoints& points, Crossings undisplaced, const GridPart& part,
                           const MeshingContext& context)
{
  const SurfaceModel& model = context.model;
  GridPlaces places = displacedPlaces(points, undisplaced, context);
  const bool isAny = places.displacedCount() > 0;
  const std::vector<Index> apart = isAnywhere(isAny, part.exchange())
                                       ? wideZones(points, undisplaced, model.names.size(), part, context)
                                       : std::vector<Index>();
  if (!isAny)
  {
    return {std::move(places), std::move(undisplaced)};
  }
  Crossings crossings = updateCrossings(places, model, std::move(undisplaced), places.displacedPoints(), context);
  // The loop ends, as each round takes back displaced points.
  for (std::vector<Index> joining = joiningPoints(places, crossings, apart); !joining.empty();
       joining = joiningPoints(places, crossings, apart))
  {
    context.progress.check();
    std::for_each(joining.begin(), joining.end(), [&](Index point) { places.undisplace(point); });
    crossings = updateCrossings(places, model, std::move(crossings), joining, context);
  }
  return {std::move(places), std::move(crossings)};
}

} // namespace atria
