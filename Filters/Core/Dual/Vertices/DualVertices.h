// SPDX-License-Identifier: GPL-3.0-or-later
/// Places and classifies the vertices of the mesh, one per leaf.
#pragma once

#include "Dual/Grid/Crossings.h"

#include <unordered_map>

namespace atria {

/// Pieces of the model to which a vertex is confined when it moves.
enum class VertexClass : std::uint8_t
{
  free,     ///< anywhere, in the domain's planes through its octant
  surface,  ///< on charts
  curve,    ///< on feature curves
  adjacent, ///< on the charts that meet at its curves: detached from these
  fixed,    ///< at a corner, on several pieces, or on none of those it should be on
  detached  ///< near its first position: off the pieces it should be on, or in a cluster
};

/// Limits how far a detached vertex may be, along each axis, from its first position.
struct DisplacementLimit
{
  Vec3 origin;
  double reach;
};

/// Classes of vertices and the pieces they belong to.
struct VertexClassification
{
  std::vector<VertexClass> classes;
  std::vector<Index> leaves;
  /// Charts of vertices on surfaces, and curves of vertices on curves.
  std::vector<Index> offsets;
  std::vector<Index> pieces;
  /// Planes of the domain (by Direction, as bits) in which vertices stay; if empty, those through their octants.
  std::vector<std::uint8_t> planes = {};
  /// Lateral sides of a turned domain (by Direction, as bits) on which vertices stay; empty without such a domain.
  std::vector<SideBits> turnedSides = {};
  /// Limits of detached vertices.
  std::unordered_map<Index, DisplacementLimit> displacementLimits = {};

  std::span<const Index> piecesOf(Index vertex) const
  {
    return {pieces.data() + offsets[vertex], pieces.data() + offsets[vertex + 1]};
  }
  /// Appends a vertex with the properties of another one.
  void appendCopyOf(Index vertex);
};

/// Vertices of leaves.
struct DualVertices
{
  std::vector<Vec3> positions;
  VertexClassification classification;
  /// 1 if the vertex should be on several pieces of the model, or at a corner, and is not: they do not meet near the
  /// octant, which is as fine as was allowed.
  std::vector<char> compromised;
};

/// Places the vertex of each of `leaves`, which are in order. The faces around a vertex determine its class
/// (LeafTopology): on a corner of the model, on a feature curve, on a surface, or free. A free one keeps the center of
/// its octant; one on a curve goes to the middle of the curve's piece in the octant, one on a surface to the mean of
/// the points where the octant's edges are cut, projected. Corners go to the vertices of their curves that are nearest
/// to them, one each. Vertices that are compromised or in a cluster are detached. On a domain side the vertex lies
/// exactly in the side's plane, and on corners and curves of the surfaces that lie there.
DualVertices placeVertices(const Octree& octree, const SurfaceModel& model, const Crossings& crossings,
                           const std::vector<Index>& leaves, const RunContext& context);

} // namespace atria
