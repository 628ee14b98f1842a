// SPDX-License-Identifier: GPL-3.0-or-later
/// Searches moves of several grid points that together resolve more.
#pragma once

#include "Dual/Displacement/PlaceMoves.h"
#include "Support/RunContext.h"

#include <map>

namespace atria {

/// Moves several points if no move of a single one gains anything. Points around an unresolved octant return to the
/// planes of gaps they left, although that leaves more unresolved beside it, and points there are moved in turn. Chains
/// that gain in all are kept.
class MoveChains
{
public:
  /// Notes where points are now: in the planes of gaps.
  MoveChains(MovingGrid& grid, PlaceMoves& moves);

  /// Tries chains from each of these leaves that is unresolved. Returns the points whose costs change.
  std::set<Index> run(const std::set<Index>& leaves, const RunContext& context);
  /// Returns the unresolved leaves around these points.
  std::set<Index> unresolvedAbout(const std::set<Index>& points);

private:
  using Places = PlaceMoves::Places;

  void moveChain(Index leaf, std::set<Index>& changed);
  std::vector<Places> returnsToPlanes(Index leaf) const;
  Places follow(const Places& start);
  PlaceMove bestBeside(const Places& trail);

  MovingGrid& grid;
  PlaceMoves& moves;
  /// Places of points in the planes of gaps.
  std::map<Index, LatticePoint> inPlanes;
};

} // namespace atria
