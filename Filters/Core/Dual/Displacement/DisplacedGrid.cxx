// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/DisplacedGrid.h"

#include "Dual/Displacement/GapPlanes.h"
#include "Dual/Displacement/PlaceSearch.h"
#include "Dual/Displacement/ZonesApart.h"

#include <algorithm>

namespace atria {

namespace {

void movePoints(GridPlaces& places, const SurfaceModel& model, TriangleTreeOnDemand& tree, const Crossings& home,
                const RunContext& context)
{
  MovingGrid grid(places, model, tree, home, context);
  constexpr int gapRounds = 4;
  for (const double reach : {0.5, 1.0})
  {
    for (int round = 0; round < gapRounds && enterGaps(grid, reach, context); ++round)
    {
      context.progress.check();
    }
  }
  searchPlaces(grid, context);
}

} // namespace

Crossings modifyGrid(GridPlaces& grid, const SurfaceModel& model, TriangleTreeOnDemand& tree, Crossings home,
                     const RunContext& context)
{
  movePoints(grid, model, tree, home, context);
  if (grid.movedCount() == 0)
  {
    return home;
  }
  constexpr int mostRounds = 20;
  const std::vector<Index> apart = wideZones(grid.points(), home, context);
  Crossings crossings = updateCrossings(grid, model, std::move(home), grid.movedPoints(), context);
  for (int round = 0; round < mostRounds; ++round)
  {
    context.progress.check();
    const std::vector<Index> joining = joiningPoints(grid, crossings, apart);
    if (joining.empty())
    {
      return crossings;
    }
    std::for_each(joining.begin(), joining.end(), [&](Index point) { grid.moveHome(point); });
    crossings = updateCrossings(grid, model, std::move(crossings), joining, context);
  }
  const std::vector<Index> moved = grid.movedPoints();
  grid.moveAllHome();
  return updateCrossings(grid, model, std::move(crossings), moved, context);
}

} // namespace atria
