// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/PlaceMoves.h"

#include "Dual/Displacement/CandidatePlaces.h"

#include <algorithm>

namespace atria {

namespace {

/// Cost of a move of a point by its shortest edge; one surplus sheet costs 1.
constexpr double moveCost = 0.05;

} // namespace

std::vector<PlaceMove> PlaceMoves::best(const std::vector<Index>& points, bool across) const
{
  constexpr std::size_t grain = 8;
  std::vector<PlaceMove> found(points.size());
  grid.forEach(points.size(), grain, context,
               [&](std::size_t i, MovingGrid::Look& look) { found[i] = best(points[i], across, look); });
  return found;
}

PlaceMove PlaceMoves::best(Index point, bool across, MovingGrid::Look& look) const
{
  PlaceMove best{0.0, point, {}};
  const double before = costAt(point, look);
  if ((before < 1.0 && !grid.places().isDisplaced(point)) || grid.isFixed(point))
  {
    return best;
  }
  const LatticePoint from = grid.places().place(point);
  for (const LatticePoint& place : candidatePlaces(grid, point, look, across))
  {
    if (place != from)
    {
      const double way = costOfWay(point, place);
      const double gain = before - (grid.surplusAbout(point, place, look, before - best.gain - way).cost() + way);
      if (gain > best.gain + smallestGain)
      {
        best.gain = gain;
        best.place = place;
      }
    }
  }
  return best;
}

double PlaceMoves::displacementOf(Index point, const LatticePoint& place) const
{
  return (toVector(place) - toVector(grid.places().undisplaced(point))).norm();
}

double PlaceMoves::costAt(Index point, MovingGrid::Look& look) const
{
  return grid.surplusAbout(point, look).cost() + costOfWay(point, grid.places().place(point));
}

double PlaceMoves::costOfWay(Index point, const LatticePoint& place) const
{
  return moveCost * displacementOf(point, place) / static_cast<double>(grid.shortestEdge(point));
}

/// Returns the cost of what is around these points at their present places.
double PlaceMoves::costOf(const Places& places)
{
  double cost = grid.surplusAbout(places).cost();
  for (const auto& [point, place] : places)
  {
    cost += costOfWay(point, grid.places().place(point));
  }
  return cost;
}

double PlaceMoves::make(const Places& places, MovingGrid::Trail& trail)
{
  const double before = costOf(places);
  grid.moveTogether(places, &trail);
  return costOf(places) - before;
}

void PlaceMoves::addAffected(Index point, std::set<Index>& affected) const
{
  for (const Index leaf : grid.points().leaves[point])
  {
    for (const Index corner : grid.points().atCorner[leaf])
    {
      if (corner != noIndex && !grid.isFixed(corner))
      {
        affected.insert(corner);
      }
    }
  }
}

} // namespace atria
