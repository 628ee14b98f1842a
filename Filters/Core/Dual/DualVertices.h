// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Crossings.h"

namespace atria {

/// Vertices of leaves.
struct DualVertices
{
  std::vector<Vec3> positions;
  /// Whether the vertex serves several smooth pieces of the model and does not lie on all of them: they do not meet in
  /// the octant, which is as fine as was allowed.
  std::vector<char> compromised;
};

/// Places the vertex of each of `leaves`, which are in order. An octant that no surface cuts keeps its centre. One that
/// is cut goes to, in this order: a corner of the model in it, where a curve of a piece that cuts it ends or turns; the
/// middle of the feature curve in it that bounds such a piece; the mean of the points where the surfaces cut its edges,
/// projected to them. On a domain side the vertex lies exactly in the side's plane, and on corners and curves of the
/// surfaces that lie there.
DualVertices placeVertices(const Octree& octree, const SurfaceModel& model, const Crossings& crossings,
                           const std::vector<Index>& leaves, const RunContext& context);

} // namespace atria
