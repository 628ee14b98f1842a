// SPDX-License-Identifier: GPL-3.0-or-later
/// Gaps ahead of a model's boundary edges, as they are listed and closed.
#pragma once

#include "Octree/Tree/MeshingContext.h"
#include "Surface/Triangles/BoundaryEdges.h"

namespace atria {

/// A triangle that bridges a gap, wound as the triangle of the boundary edge is.
using BridgeTriangle = std::array<LatticePoint, 3>;

/// What is ahead of a place of a boundary edge.
struct BoundaryStation
{
  LatticePoint at;
  /// To the nearest thing ahead; zero where something touches, nothing where there is none within an octant.
  std::optional<Vec3> across;
  /// Of the leaf there.
  double octantSize;

  bool isBridged(double widest) const { return across && across->norm() <= widest * octantSize; }
};

/// The boundary edges of a model (boundaryOf) and what is ahead of them.
///
/// Along each edge, in steps of a quarter of a finest octant, the nearest place is looked for of the walls of the
/// model and of the domain sides that is ahead (isAhead). On the model it must be nearest among all that is connected
/// there, so that sides of an opening that meet in its corner are no gap. There are none in clusters.
struct BoundaryGaps
{
  BoundaryEdges boundary;
  /// Per boundary edge, from a to b, ends included; empty where nothing is ahead.
  std::vector<std::vector<BoundaryStation>> stations;

  /// The bridge over the step between two stations; nothing where either is wider than `widest` octants.
  std::vector<BridgeTriangle> bridge(Index edge, std::size_t step, double widest) const;
  /// Between the bridges of two boundary edges at the point in which they meet.
  std::vector<BridgeTriangle> cornerBridge(const BoundaryEdges::End& one, const BoundaryEdges::End& other,
                                           double widest, const SurfaceModel& model) const;
};

/// The result does not depend on threads. O(steps), each with a search of the model's tree.
BoundaryGaps findBoundaryGaps(const MeshingContext& context);

} // namespace atria
