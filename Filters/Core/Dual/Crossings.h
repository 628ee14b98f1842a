// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/DualMesh.h"
#include "Dual/GridPoints.h"
#include "Surface/SurfaceModel.h"

namespace atria {

/// Where a surface cuts an octree edge.
struct SurfaceCrossing
{
  Index triangle;
  /// Lattice coordinate along the edge's axis.
  double coordinate;
  /// +1 where the triangle's normal points along the axis, -1 against it.
  int orientation;
};

/// An octree edge that surfaces cut: between grid points, or from one to outside the domain.
struct CrossedEdge
{
  /// The grid point the edge was found from, and the one at the other end or noIndex.
  Index point;
  Index other;
  std::uint8_t direction;
  /// Where `point` is.
  LatticePoint start;
  /// The crossings next to `point` and next to the other end; the same if there is one only.
  SurfaceCrossing nearest;
  SurfaceCrossing farthest;
  /// Number of crossings; above 1 sheets are merged into one.
  std::uint32_t count;
  /// Leaves about the edge.
  std::array<Index, 4> leaves;
};

/// What stands between elements.
struct Crossings
{
  /// Per grid point and Direction: as DualMesh::neighbours.
  std::vector<std::array<std::int32_t, 6>> neighbours;
  std::vector<BoundaryFace> boundaryFaces;
  std::vector<CrossedEdge> crossedEdges;
};

/// Joins grid points across edges, and finds which edges are cut by surfaces or by the domain's sides. Decisions are
/// exact; see Predicates.h. A surface that reaches through an edge and back, by a bulge or a crease, does not cut it.
/// Cost: O(1) an edge, plus the triangles in the leaf beside it.
Crossings findCrossings(const Octree& octree, const SurfaceModel& model, const GridPoints& points,
                        const RunContext& context);

} // namespace atria
