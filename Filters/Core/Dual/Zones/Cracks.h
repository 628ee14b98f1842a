// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Zones/Zones.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// A gap of the model beside a boundary edge, narrower than the octants there.
struct Crack
{
  /// The line in the middle of the gap, two points at least.
  std::vector<Vec3> path;
  /// The largest distance from the boundary edge to what is across.
  double width;
  /// A grid point beside it in a zone that is kept.
  Index point;
  /// Whether an uncut octree edge passes through it, so that the spaces on both sides are one zone. Else the mesh
  /// closes it.
  bool open;
};

/// Looks along the boundary edges of the model, in steps of a quarter of an octant. There is a gap at a place of the
/// boundary edge if the nearest part of another triangle, or of a domain side, that lies within 60 degrees of the
/// direction in which the boundary edge's triangle would go on, is nearer than the edge of the leaf there and farther
/// than 1e-4 of it. It is open if an uncut octree edge passes between the two, also where that is so near along the
/// boundary edge that the edge's dual face reaches there.
///
/// A gap that faces across the boundary edge, as between sheets that lap, is not looked for. Steps that follow each
/// other, over the points of the boundary edge too, are one crack; what both of its boundary edges tell is told once.
/// Closed cracks come first, and long ones. The result does not depend on threads.
std::vector<Crack> findCracks(const Zones& zones, const std::vector<char>& kept, const Crossings& crossings,
                              const GridPlaces& grid, const MeshingContext& context);

} // namespace atria
