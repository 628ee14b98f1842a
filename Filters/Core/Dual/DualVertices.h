// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Crossings.h"

namespace atria {

/// Places the vertex of each of `leaves`. An octant that no surface cuts keeps its centre. One that is cut goes to, in this
/// order: a corner of the model in it; the middle of the feature curve in it that bounds a smooth piece which cuts it; the mean of
/// the points where the surfaces cut its edges, projected to them. On a domain side the vertex lies exactly in the side's plane, and
/// on corners and curves of the surfaces that lie there.
std::vector<Vec3> placeVertices(const Octree& octree, const SurfaceModel& model, const Crossings& crossings,
                                const std::vector<Index>& leaves, const RunContext& context);

} // namespace atria
