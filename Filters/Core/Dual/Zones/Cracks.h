// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists the narrow gaps ahead of boundary edges that the mesh closes or leaves open.
#pragma once

#include "Dual/Zones/BoundaryGaps.h"
#include "Dual/Zones/Zones.h"

namespace atria {

/// A gap ahead of a boundary edge, narrower than the octants there.
struct Crack
{
  /// The line in the middle of the gap, two points at least.
  std::vector<Vec3> path;
  /// The largest distance from the boundary edge to what is across.
  double width;
  /// A grid point beside it in a zone that is kept; noIndex if another process owns it.
  Index point;
  /// True if an uncut octree edge passes through it, so that the spaces on both sides are one zone. Else the mesh
  /// closes it.
  bool open;
};

/// Lists the gaps of a model's boundary edges in zones that are kept. A gap is open where an uncut octree edge passes
/// its bridge, and as far along the boundary edge as that edge's dual face reaches.
///
/// Gaps that face across the boundary edge, as between sheets that lap, are not found. Consecutive steps are one crack,
/// also across points of boundary edges. A crack between two boundary edges is reported once. Closed cracks come before
/// open ones, and long ones before short ones. The result does not depend on threads. Every process gets all cracks.
/// \param kept  One entry per zone, and one more for the points that a process does not know.
std::vector<Crack> findCracks(const BoundaryGaps& gaps, const Zones& zones, const std::vector<char>& kept,
                              const Crossings& crossings, const GridPlaces& grid, const GridPart& part,
                              const MeshingContext& context);

} // namespace atria
