// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Zones.h"

namespace atria {

/// A gap of the model beside a free rim, narrower than the octants there, that the mesh closes: no uncut octree edge
/// passes through it, so that no zone reaches through it.
struct ClosedCrack
{
  /// The line in the middle of the gap, two points at least.
  std::vector<Vec3> path;
  /// The largest distance from the rim to what is across.
  double width;
  /// A grid point beside it in a zone that is kept.
  Index point;
};

/// Looks along the rims of the model, in steps of a quarter of an octant. There is a crack at a place of the rim if
/// - the nearest part of another triangle, or of a domain side, that lies within 60 degrees of the direction in which
///   the rim's triangle would go on, is nearer than the edge of the leaf there and farther than 1e-4 of it; and
/// - no uncut octree edge passes between the two, nor so near along the rim that its dual face reaches there.
/// A gap that faces across the rim, as between sheets that lap, is not looked for. Steps that follow each other, over
/// the points of the rim too, are one crack; what both of its rims tell is told once. The result does not depend on
/// threads.
std::vector<ClosedCrack> findClosedCracks(const Zones& zones, const std::vector<char>& kept, const Crossings& crossings,
                                          const Octree& octree, const GridPoints& points, const SurfaceModel& model,
                                          const RunContext& context);

} // namespace atria
