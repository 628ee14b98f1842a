// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the gaps ahead of a model's boundary edges, so that they can be listed and closed.
#pragma once

#include "Octree/Tree/MeshingContext.h"
#include "Surface/Triangles/BoundaryEdges.h"

namespace atria {

/// A triangle that bridges a gap, wound like the triangle of the boundary edge.
using BridgeTriangle = std::array<LatticePoint, 3>;

/// A place on a boundary edge, and the way across the gap ahead of it.
struct BoundaryStation
{
  LatticePoint at;
  /// Way to the nearest thing ahead; zero if something touches, nullopt if there is none within an octant.
  std::optional<Vec3> across;
  /// Edge length of the leaf there.
  double octantSize;

  bool isBridged(double widest) const { return across && across->norm() <= widest * octantSize; }
};

/// The boundary edges of a model (boundaryOf) and what is ahead of them.
///
/// Searches along each edge, in steps of a quarter of a finest octant, for the nearest place ahead (isAhead) on the
/// walls of the model and on the domain sides. On the model no connected place may be nearer, so that sides of an
/// opening that meet in its corner are no gap. There are no gaps in clusters.
struct BoundaryGaps
{
  BoundaryEdges boundary;
  /// One list per boundary edge: stations from a to b, ends included; empty if nothing is ahead.
  std::vector<std::vector<BoundaryStation>> stations;

  /// Returns the bridge over the step between two stations; empty if the gap at one is wider than `widest` octants.
  std::vector<BridgeTriangle> bridge(Index edge, std::size_t step, double widest) const;
  /// Returns what joins the bridges of two boundary edges at the point in which they meet.
  std::vector<BridgeTriangle> cornerBridge(const BoundaryEdges::End& one, const BoundaryEdges::End& other,
                                           double widest, const SurfaceModel& model) const;
};

/// Finds the gaps. The result does not depend on threads. O(steps), each with a search of the model's tree.
BoundaryGaps findBoundaryGaps(const MeshingContext& context);

} // namespace atria
