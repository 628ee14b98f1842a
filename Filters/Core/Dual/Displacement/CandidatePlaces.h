// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists places to which a grid point may move so that less is unresolved.
#pragma once

#include "Dual/Displacement/MovingGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace atria {

/// Collects places for a grid point that are at most `reach` from its undisplaced place along each axis.
struct CandidatePlaces
{
  LatticePoint undisplaced;
  std::int64_t reach;
  std::vector<LatticePoint> places;

  void add(const Vec3& p)
  {
    const LatticePoint place{std::llround(p[0]), std::llround(p[1]), std::llround(p[2])};
    const bool near = std::abs(place[0] - undisplaced[0]) <= reach && std::abs(place[1] - undisplaced[1]) <= reach &&
                      std::abs(place[2] - undisplaced[2]) <= reach;
    if (near && std::find(places.begin(), places.end(), place) == places.end())
    {
      places.push_back(place);
    }
  }

  /// Adds the point nearest to p in the plane in the middle between a and b, if there are both.
  void addBetween(const Vec3& p, const std::optional<Vec3>& a, const std::optional<Vec3>& b)
  {
    if (a && b && (*a - *b).squaredNorm() > 1.0)
    {
      const Vec3 along = (*a - *b).normalized();
      add(p - along * along.dot(p - 0.5 * (*a + *b)));
    }
  }
};

/// Returns how far a point may move along each axis: a part of its shortest edge, in lattice units.
std::int64_t farthestReach(const MovingGrid& grid, Index point);

/// Returns places where a grid point may leave less unresolved: its undisplaced place; between the cuts of its edges
/// and a step beyond them; past a curve in which two sheets that cut an edge meet; between curves that an octant's
/// vertex cannot both be on. With `across`, also the nearest places across sheets of its octants that do not meet
/// there. Alone, such moves may take a sheet out of the octants beside its boundary edge.
std::vector<LatticePoint> candidatePlaces(const MovingGrid& grid, Index point, MovingGrid::Look& look,
                                          bool across = false);

} // namespace atria
