// SPDX-License-Identifier: GPL-3.0-or-later
/// The layer of elements about all walls (pillow).
#pragma once

#include "Layer/LayerDirections.h"
#include "Layer/LayerTopology.h"

namespace atria {

/// Doubles the points of walls, one prism on each side of every wall, and moves the copies off the walls: along the
/// direction that is farthest inside all of them, by the thickness asked for, or less where elements would become
/// worse than they were. At boundary edges the layer tapers to nothing.
///
/// Points are left single where `findLayerWalls` says so, where `excluded` (by point of the plain mesh; may be empty)
/// is set, where no direction is feasible, and where a prism would lie flat on its wall as no copy lifts off it. The
/// plain mesh is not changed, so that a caller who finds no room somewhere can exclude points and grow the layer again.
/// The same bits for any number of threads.
LayerMesh growLayer(const DualMesh& plain, const LayerWalls& walls, const LayerOptions& options,
                    const std::vector<char>& excluded, const RunContext& context);

/// For each point that has a count the longest edge of an element that leaves its walls, half of it where another wall
/// is at the other end; where none leaves them, as in the corner of a room, the shortest edge along them. Infinite for
/// other points.
///
/// The longest, as the layer then is thicker at the vertices of large octants than at those of small ones beside them,
/// which opens elements between the two that lie flat on the wall.
std::vector<double> findWallSizes(const DualMesh& mesh, const LayerWalls& walls, const std::vector<Index>& counts,
                                  const RunContext& context);

/// How thick the layers of one point should be in all, its size being known.
double thicknessAsked(const WallLayers& layers, double wallSize, const LayerOptions& options);

} // namespace atria
