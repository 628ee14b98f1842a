// SPDX-License-Identifier: GPL-3.0-or-later
/// Grows one layer of elements along all walls (pillowing).
#pragma once

#include "Layer/LayerDirections.h"
#include "Layer/LayerTopology.h"

namespace atria {

/// Doubles the points of walls, one prism on each side of every wall, and moves the copies off the walls. A copy moves
/// along the direction that is farthest inside all walls, by the requested thickness, or by less if elements would get
/// worse than they were. The layer tapers to nothing at boundary edges.
///
/// Points stay single
/// - where `findLayerWalls` gives no layer,
/// - where `excluded` is set (one entry per point of the plain mesh; may be empty),
/// - where no direction is feasible, unless layers wrap (LayerOptions::wraps),
/// - where a prism would lie flat on its wall because no copy lifts off it, likewise.
///
/// The plain mesh is not changed, so a caller who finds no room somewhere can move or exclude points and grow the layer
/// again. The result has the same bits for any number of threads.
class LayerGrower
{
public:
  /// Both must outlive this.
  LayerGrower(const LayerWalls& walls, const LayerOptions& options)
      : walls_(walls), options_(options), directions_(walls, options)
  {
  }

  LayerMesh grow(const DualMesh& plain, const std::vector<char>& excluded, const RunContext& context);
  /// Grows the layer of the same mesh after points moved. Copies in `before` keep their positions, except those of
  /// `fresh` points.
  LayerMesh growAgain(const DualMesh& plain, const std::vector<char>& excluded, const LayerMesh& before,
                      const std::vector<char>& fresh, const RunContext& context);

private:
  std::vector<Index> countsOf(const DualMesh& plain, const std::vector<char>& excluded, const RunContext& context);

  const LayerWalls& walls_;
  const LayerOptions& options_;
  LayerDirections directions_;
};

/// Returns the size of the elements at each point that has a count, in model units; infinity for other points. The size
/// is the longest edge of an element that leaves the point's walls; edges between two walls count half. If no edge
/// leaves them, as in the corner of a room, it is the shortest edge along them.
///
/// The longest edge makes the layer thicker at the vertices of large octants than at those of small ones beside them.
/// This opens elements between the two that lie flat on the wall.
///
/// Only edges of `elements` count.
std::vector<double> findWallSizes(const DualMesh& mesh, const LayerWalls& walls, const std::vector<Index>& counts,
                                  const std::vector<Index>& elements, const RunContext& context);

/// Returns the elements with a marked point, in order.
std::vector<Index> elementsAt(const DualMesh& mesh, const std::vector<char>& marked, const Executor& executor);

} // namespace atria
