// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/DisplacedGrid.h"

#include "Dual/Displacement/GapPlanes.h"
#include "Dual/Displacement/PlaceSearch.h"
#include "Dual/Displacement/ZonesApart.h"

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

DisplacedGrid displaceGrid(const GridPoints& points, Crossings undisplaced, const MeshingContext& context)
{
  const SurfaceModel& model = context.model;
  GridPlaces places = displacedPlaces(points, undisplaced, context);
  if (places.displacedCount() == 0)
  {
    return {std::move(places), std::move(undisplaced)};
  }
  const std::vector<Index> apart = wideZones(points, undisplaced, context);
  Crossings crossings = updateCrossings(places, model, std::move(undisplaced), places.displacedPoints(), context);
  // Each round takes back displaced points, so that there is a last one.
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
