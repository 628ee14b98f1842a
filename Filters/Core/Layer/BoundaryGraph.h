// SPDX-License-Identifier: GPL-3.0-or-later
/// The boundary of a mesh as a surface.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Support/Angles.h"
#include "Support/Buckets.h"
#include "Support/RunContext.h"

#include <span>

namespace atria {

/// Two edges on a curve or crease are in line beyond this angle.
inline const double inLineCosine = cosOfDegrees(149.99);

/// Edge i of a boundary face runs from corner i to corner i + 1 of hexahedronFace[direction]; where both are one point
/// there is no edge.
struct BoundaryGraph
{
  /// No edge there.
  static constexpr Index noEdge = noIndex;
  /// An edge that other than two faces have.
  static constexpr Index branching = noIndex - 1;
  static constexpr bool isEdge(Index code) { return code < branching; }
  static constexpr Index faceOf(Index code) { return code >> 2; }
  static constexpr int edgeOf(Index code) { return static_cast<int>(code & 3); }

  /// Per boundary face and edge: 4 * f + i for edge i of face f across it, or noEdge, or branching.
  std::vector<std::array<Index, 4>> across;
  /// By point of the mesh, the boundary faces about it, in order.
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

/// O(n log n) in boundary faces.
BoundaryGraph findBoundaryGraph(const DualMesh& mesh, const RunContext& context);

/// The faces about a point in turn, each the one across the edge that leaves the point. Empty where they are no single
/// closed fan: where edges branch, or where parts of the boundary touch in the point only.
std::vector<Index> fanAt(const DualMesh& mesh, const BoundaryGraph& graph, Index point);

/// The face on the other side of the sheet, or noIndex.
inline Index faceBehind(const DualMesh& mesh, const BoundaryFace& face)
{
  const std::int32_t code =
      face.opposite == noIndex ? DualMesh::noFace : mesh.neighbors[face.opposite][opposite(face.direction)];
  return DualMesh::isBoundary(code) ? DualMesh::boundaryFaceOf(code) : noIndex;
}

} // namespace atria
