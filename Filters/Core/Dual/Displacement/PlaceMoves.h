// SPDX-License-Identifier: GPL-3.0-or-later
/// Moves grid points, and counts what that costs.
#pragma once

#include "Dual/Displacement/MovingGrid.h"

namespace atria {

/// Gains below this are rounding.
inline constexpr double smallestGain = 1e-9;

/// A better place for a point.
struct PlaceMove
{
  double gain = 0.0;
  Index point = noIndex;
  LatticePoint place{};
};

/// Moves points of the grid and returns what that costs: the surplus cuts of a point's edges, twice; the surplus sheets
/// and curves of its octants, once; and a little for the distance from its undisplaced place.
class PlaceMoves
{
public:
  /// Points and their places.
  using Places = MovingGrid::PointPlaces;

  PlaceMoves(MovingGrid& moving, const RunContext& run) : grid(moving), context(run) {}

  double displacementOf(Index point, const LatticePoint& place) const;
  /// Returns the best move of each of these points, which stay where they are. The gain is 0 if no place is better. For
  /// `across` see candidatePlaces.
  std::vector<PlaceMove> best(const std::vector<Index>& points, bool across = false) const;
  /// Moves points together, each once, and adds that to `trail`. Returns the change of the cost.
  double make(const Places& places, MovingGrid::Trail& trail);

  /// Adds the points that may move and whose costs depend on where a point is.
  void addAffected(Index point, std::set<Index>& affected) const;

private:
  PlaceMove best(Index point, bool across, MovingGrid::Look& look) const;
  double costAt(Index point, MovingGrid::Look& look) const;
  double costOf(const Places& places);
  double costOfWay(Index point, const LatticePoint& place) const;

  MovingGrid& grid;
  const RunContext& context;
};

} // namespace atria
