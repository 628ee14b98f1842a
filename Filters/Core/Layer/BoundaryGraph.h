// SPDX-License-Identifier: GPL-3.0-or-later
/// Graph of a mesh's boundary faces: neighbors across edges, and faces around points.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Support/Angles.h"
#include "Support/Buckets.h"
#include "Support/RunContext.h"

#include <span>

namespace atria {

/// Cosine of the angle beyond which two edges on a curve or crease are in line.
inline const double inLineCosine = cosOfDegrees(149.99);

/// Edge i of a boundary face runs from corner i to corner i + 1 of hexahedronFace[direction]. There is no edge if both
/// corners are one point.
struct BoundaryGraph
{
  /// No edge there.
  static constexpr Index noEdge = noIndex;
  /// An edge whose number of faces is not two.
  static constexpr Index branching = noIndex - 1;
  static constexpr bool isEdge(Index code) { return code < branching; }
  static constexpr Index faceOf(Index code) { return code >> 2; }
  static constexpr int edgeOf(Index code) { return static_cast<int>(code & 3); }

  /// One entry per boundary face and edge: 4 * f + i for edge i of the face f across it; or noEdge, or branching.
  std::vector<std::array<Index, 4>> across;
  /// One entry per point of the mesh: the boundary faces around it, in rising order.
  Buckets faces;

  std::span<const Index> facesAt(Index point) const { return faces.of(point); }
};

inline Index cornerOf(const DualMesh& mesh, const BoundaryFace& face, int i)
{
  return mesh.corners[face.element][hexahedronFace[face.direction][i & 3]];
}

inline std::array<Index, 4> cornersOf(const DualMesh& mesh, const BoundaryFace& face)
{
  return {cornerOf(mesh, face, 0), cornerOf(mesh, face, 1), cornerOf(mesh, face, 2), cornerOf(mesh, face, 3)};
}

/// Finds the graph of a mesh's boundary. O(n log n) in boundary faces.
BoundaryGraph findBoundaryGraph(const DualMesh& mesh, const RunContext& context);

/// Returns the faces around a point in turn, each across the edge of the last one that leaves the point. Empty if they
/// are not a single closed fan: edges branch, or parts of the boundary touch only in the point.
std::vector<Index> fanAt(const DualMesh& mesh, const BoundaryGraph& graph, Index point);

/// Returns the face on the other side of the sheet, or noIndex.
inline Index faceBehind(const DualMesh& mesh, const BoundaryFace& face)
{
  const std::int32_t code =
      face.opposite == noIndex ? DualMesh::noFace : mesh.neighbors[face.opposite][opposite(face.direction)];
  return DualMesh::isBoundary(code) ? DualMesh::boundaryFaceOf(code) : noIndex;
}

} // namespace atria
