// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists the narrow gaps ahead of boundary edges that the mesh closes or leaves open.
#pragma once

#include "Dual/Zones/BoundaryGaps.h"
#include "Dual/Zones/Zones.h"

#include <functional>

namespace atria {

/// A gap ahead of a boundary edge, narrower than the octants there.
struct Crack
{
  /// The line in the middle of the gap, two points at least.
  std::vector<Vec3> path;
  /// The largest distance from the boundary edge to what is across.
  double width;
  /// A grid point beside it in a zone that is kept.
  Index point;
  /// True if an uncut octree edge passes through it, so that the spaces on both sides are one zone. Else the mesh
  /// closes it.
  bool open;
};

/// A step along a boundary edge, of as many as the edge has, and the gap there.
struct CrackStep
{
  enum Kind : std::uint8_t
  {
    none,
    closed,
    open
  };

  Kind kind = none;
  Index edge = noIndex;
  Index place = 0;
  Index count = 1;
  /// Half way across the gap.
  Vec3 begin = Vec3::Zero();
  Vec3 end = Vec3::Zero();
  double width = 0.0;
  double octantSize = 0.0;
  Index point = noIndex;

  double length() const { return (end - begin).norm(); }
};

/// The steps that are gaps in zones that are kept and have their middle in a leaf that `isSeen`; see findCracks.
std::vector<CrackStep> findCrackSteps(const BoundaryGaps& gaps, const Zones& zones, const std::vector<char>& kept,
                                      const Crossings& crossings, const GridPlaces& grid,
                                      const std::function<bool(Index leaf)>& isSeen, const MeshingContext& context);

/// Joins steps, which may be in any order, to cracks. Points are those of the steps.
std::vector<Crack> joinCracks(const BoundaryEdges& boundary, const std::vector<CrackStep>& steps);

/// Lists the gaps of a model's boundary edges in zones that are kept. One is open where an uncut octree edge passes its
/// bridge, also so near along the boundary edge that the edge's dual face reaches there.
///
/// A gap that faces across the boundary edge, as between sheets that lap, is not searched. Steps that follow each
/// other, over the points of the boundary edges too, are one crack. A crack that both of its boundary edges show is
/// reported once. Closed cracks come first, and long ones. The result does not depend on threads.
std::vector<Crack> findCracks(const BoundaryGaps& gaps, const Zones& zones, const std::vector<char>& kept,
                              const Crossings& crossings, const GridPlaces& grid, const MeshingContext& context);

} // namespace atria
