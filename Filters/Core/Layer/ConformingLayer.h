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
/// plain mesh is not changed, so that a caller who finds no room somewhere can move or exclude points and grow the
/// layer again. The same bits for any number of threads.
class LayerGrower
{
public:
  /// Both must outlive this.
  LayerGrower(const LayerWalls& walls, const LayerOptions& options)
      : walls_(walls), options_(options), directions_(walls, options)
  {
  }

  LayerMesh grow(const DualMesh& plain, const std::vector<char>& excluded, const RunContext& context);
  /// Of the same mesh with other places of points. Copies that points have in `before` stay where they are there, but
  /// for those of `fresh` points.
  LayerMesh growAgain(const DualMesh& plain, const std::vector<char>& excluded, const LayerMesh& before,
                      const std::vector<char>& fresh, const RunContext& context);

private:
  std::vector<Index> countsOf(const DualMesh& plain, const std::vector<char>& excluded, const RunContext& context);

  const LayerWalls& walls_;
  const LayerOptions& options_;
  LayerDirections directions_;
};

/// For each point that has a count the longest edge of an element that leaves its walls, half of it where another wall
/// is at the other end; where none leaves them, as in the corner of a room, the shortest edge along them. Infinite for
/// other points.
///
/// The longest, as the layer then is thicker at the vertices of large octants than at those of small ones beside them,
/// which opens elements between the two that lie flat on the wall.
///
/// Only edges of `elements` are looked at.
std::vector<double> findWallSizes(const DualMesh& mesh, const LayerWalls& walls, const std::vector<Index>& counts,
                                  const std::vector<Index>& elements, const RunContext& context);

/// Elements with a marked point, in order.
std::vector<Index> elementsAt(const DualMesh& mesh, const std::vector<char>& marked, const Executor& executor);

/// How thick the layers of one point should be in all, its size being known.
double thicknessAsked(const WallLayers& layers, double wallSize, const LayerOptions& options);

} // namespace atria
