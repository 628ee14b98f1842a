// SPDX-License-Identifier: GPL-3.0-or-later
/// Reports on the zones of a model, and on ways by which closed ones leak.
#pragma once

#include "Grid/Prism.h"

#include <cstdint>
#include <vector>

namespace atria {

enum class ZoneKind : std::uint8_t
{
  open,   ///< reaches a side of the domain other than the bottom, and is not the inside of a closed body
  room,   ///< closed
  solid,  ///< the inside of a solid: of a closed body, or a zone that sees backs of surfaces, as far as known
  narrow, ///< closed, and all of its elements are at its border
  beyond, ///< behind the sides of a domain that does not stand along the grid
  ground  ///< under the ground: not kept, reaches the bottom and other sides, and has most faces on ground
};

struct ZoneSummary
{
  std::size_t elements = 0;
  bool kept = false;
  /// Domain sides that it reaches.
  SideBits sides = 0;
  /// A point that means this zone if it is a seed; in a large octant, away from surfaces if the zone has such a place.
  Vec3 inside = Vec3::Zero();
  /// Surfaces on its border, those with most faces first.
  std::vector<Index> surfaces;
  /// Volume of the octants, divided among their corners, in cubic model units; right to about half an octant at the
  /// border.
  double volume = 0.0;
  ZoneKind kind = ZoneKind::open;
};

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

} // namespace atria
