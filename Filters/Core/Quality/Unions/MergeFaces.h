// SPDX-License-Identifier: GPL-3.0-or-later
/// Coplanar boundary faces of one cell, and faces that the same two cells share, made into one polygon, for formats
/// that know polyhedra.
#pragma once

#include "Quality/Checks/CheckLimits.h"
#include "Quality/Checks/MeshChecks.h"
#include "Quality/Faces/FaceMesh.h"
#include "Support/RunContext.h"

#include <cstddef>
#include <span>
#include <vector>

namespace atria {

/// Two faces are coplanar where the sine of the angle between their normals is below this, and no point of theirs is
/// further from their common plane than this share of their longest edge. At 1e-6, the sine to which OpenFOAM's
/// checkMesh tells concave cells, the area of a patch changes by less than 2e-13 of it. The merged face's triangles
/// have to have angles with a greater sine than this.
inline constexpr double mergedPlanarSine = checkLimits::concaveSine;

/// What unions of cells, or of faces, leave as it is.
struct KeptParts
{
  /// Cells that are not made one with others, or whose faces are not; rising.
  std::span<const Index> cells = {};
  /// For each internal face the number of its zone or noIndex; empty, none is in one. Faces of different zones are not
  /// merged, nor cells on either side of a face of a zone.
  std::span<const Index> zoneOf = {};
  /// Where the mesh is a part of one.
  const CheckedPart* part = nullptr;
};

struct MergedFaces
{
  /// For each face before, the face that it now is or is a part of; empty if nothing was merged.
  std::vector<Index> faceOf;
  std::size_t count = 0; ///< how many faces there are fewer

  Index nowOf(Index face) const { return faceOf.empty() ? face : faceOf[face]; }
};

/// Merges boundary faces of one owner and one patch, and internal ones of one owner and one neighbor, that are
/// coplanar and share one edge or one run of edges. Cells and points stay as they are; faces stay in the order FaceMesh
/// asks for. A point that comes to lie inside a merged face is left without faces. All coplanar faces of a cell that
/// are connected are merged where that is possible, else three or two of them. Not possible it is where
/// - the merged face would not be a simple polygon, or would share with another face of its cell points that do not
///   follow each other;
/// - it is not star-shaped as OpenFOAM's checkMesh asks for: triangles from its centroid to its edges, and those from
///   one of its points, all look out of the cell (of both cells), whose centroid is not in the face's plane (flat cells
///   stay as they are); or tetrahedra of it or of another face of the cell would turn over, as its centroid moves by
///   merging;
/// - a point inside of it is one of other faces too;
/// - a cell would have fewer than four faces.
/// Two internal faces for which it is not possible may be merged without an end of their common edge. All other faces
/// with that point are between one of the two cells and another cell and lose it, too, and their cells are less concave
/// for it.
/// `patchOf` has for each boundary face the number of its patch; empty, all are in one. Faces are tried in rising order
/// of their numbers, one cell after the other: the result does not depend on threads. Merging again changes nothing.
/// Throws Aborted when asked to.
MergedFaces mergeCoplanarFaces(FaceMesh& mesh, std::span<const Index> patchOf, const RunContext& context,
                               const KeptParts& kept = {});

} // namespace atria
