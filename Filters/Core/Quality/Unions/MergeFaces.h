// SPDX-License-Identifier: GPL-3.0-or-later
/// Merges coplanar boundary faces of one cell, and coplanar faces between the same two cells, for formats with
/// polyhedra.
#pragma once

#include "Quality/Checks/CheckLimits.h"
#include "Quality/Checks/MeshChecks.h"
#include "Quality/Faces/FaceMesh.h"
#include "Support/RunContext.h"

#include <cstddef>
#include <span>
#include <vector>

namespace atria {

/// Two boundary faces are coplanar if the sine of the angle between their normals is below this, and their points are
/// no further from their common plane than this share of their longest edge. At 1e-6, the sine at which OpenFOAM's
/// checkMesh detects concave cells, the area of a patch changes by less than 2e-13 of it. The angles of the merged
/// face's triangles must have a greater sine than this.
inline constexpr double mergedPlanarSine = checkLimits::concaveSine;

/// Parts of a mesh that unions of cells or faces do not change.
struct KeptParts
{
  /// Cells that are not merged with others, or whose faces are not merged; rising.
  std::span<const Index> cells = {};
  /// One entry per internal face: the number of its zone or noIndex; empty if no face is in a zone. Faces of different
  /// zones are not merged, nor cells on either side of a zone's face.
  std::span<const Index> zoneOf = {};
  /// Set if the mesh is a part of a larger one.
  const CheckedPart* part = nullptr;
};

struct MergedFaces
{
  /// One entry per old face: the face that it is now or is part of; empty if nothing was merged.
  std::vector<Index> faceOf;
  std::size_t count = 0; ///< decrease in the number of faces

  Index nowOf(Index face) const { return faceOf.empty() ? face : faceOf[face]; }
};

/// Merges boundary faces of one owner and one patch, and internal ones of one owner and one neighbor, that are coplanar
/// and share one edge or one run of edges. Cells and points stay as they are; faces stay in the order that FaceMesh
/// requires. A point that ends up inside a merged face has no faces any more. All connected coplanar faces of a cell
/// are merged if possible, else three or two of them. It is not possible if
/// - the merged face would not be a simple polygon, or would share with another face of its cell points that do not
///   follow each other;
/// - it would not be star-shaped as OpenFOAM's checkMesh requires: triangles from its centroid to its edges, and those
///   from one of its points, must all point out of the cell (of both cells), and the cell's centroid must not be in the
///   face's plane (flat cells stay as they are);
/// - tetrahedra of it or of another face of the cell would invert, because merging moves the cell's centroid;
/// - a point inside it belongs to other faces too;
/// - a cell would have fewer than four faces.
/// Two internal faces for which it is not possible may be merged without an end of their common edge. All other faces
/// with that point must lie between one of the two cells and another cell; they lose the point too, and their cells
/// must become less concave.
/// `patchOf` has one entry per boundary face: the number of its patch; empty if all are in one. Faces are tried in
/// rising order of their numbers, one cell after the other: the result does not depend on the number of threads.
/// Merging again changes nothing. Throws Aborted when asked to.
MergedFaces mergeCoplanarFaces(FaceMesh& mesh, std::span<const Index> patchOf, const RunContext& context,
                               const KeptParts& kept = {});

} // namespace atria
