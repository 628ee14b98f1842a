// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the ways by which the zones of sealed seeds leak to the outside.
#pragma once

#include "Dual/Zones/Zones.h"

namespace atria {

/// A way from a point whose zone should be closed to the outside.
struct Leak
{
  /// Index and position of the seed.
  std::size_t index;
  Vec3 seed;
  /// The way: grid points, each joined to the next across an uncut octree edge. The first is the seed's; from the last,
  /// an edge of the grid leaves the domain in a `direction`, through the side of the number `side`.
  std::vector<Index> points;
  std::uint8_t direction;
  Index side;
  /// The same in model units, with the point on the domain's side at the end.
  std::vector<Vec3> path;
  /// The narrowest place of the way: the center of the largest ball that fits there, and its diameter.
  Vec3 place;
  double width;
  /// The surfaces that ball all but touches, nearest first; noIndex for the bare bottom of the domain.
  std::vector<Index> surfaces;
  /// The grid point before the narrowest place.
  Index point;
};

/// True if a zone reaches an open side of the domain other than its bottom.
bool isLeaking(std::int32_t zone, const Zones& zones);

/// Returns for each seed whose zone is leaking the widest way to such a side: the one whose narrowest edge is as far
/// from surfaces as possible (maximum capacity path; Pollack 1960). Throws Error for a seed outside the domain. Cost
/// where there is a leak: O(n log n) in the points of its zone.
std::vector<Leak> findLeaks(const std::vector<Vec3>& sealedSeeds, const Zones& zones, const Crossings& crossings,
                            const GridPlaces& grid, const SurfaceModel& model, const RunContext& context);

} // namespace atria
