// SPDX-License-Identifier: GPL-3.0-or-later
/// Report on the changes that made a model sound.
#pragma once

#include "Support/Types.h"

#include <cstddef>
#include <vector>

namespace atria {

/// Parts of a surface that are too fine for the mesh.
struct HiddenDetail
{
  Index surface;
  /// Triangles in clusters, where nothing is cut or moved, and their area in model units.
  std::size_t clusteredTriangles = 0;
  double clusteredArea = 0.0;
  /// The same for small parts that were left out.
  std::size_t leftOutTriangles = 0;
  double leftOutArea = 0.0;
};

/// Area in which two surfaces overlap, or one overlaps itself: one keeps its faces there, the other gives them up.
struct SharedArea
{
  Index keeps;
  Index gives;
  /// All areas in square model units.
  double area = 0.0;
  /// Part in which neither is smaller than the other, so that the order in the file decides.
  double equalArea = 0.0;
  /// Part within the domain in which a wall gives way to a face zone, so that the wall has an opening.
  double openedArea = 0.0;
};

/// Counts of the changes that made a model sound.
struct SurfaceRepairReport
{
  /// Places whose points were merged with a point at another place.
  std::size_t weldedPoints = 0;
  /// Triangles without area that were dropped.
  std::size_t degenerateTriangles = 0;
  /// Triangles dropped because another one has the same points.
  std::size_t duplicateTriangles = 0;
  /// Pieces of triangles dropped because they fall on a piece of another one.
  std::size_t overlappingTriangles = 0;
  /// Triangles that were cut where others touch them or pass through them.
  std::size_t splitTriangles = 0;
  /// Edges in which triangles now meet that only touched or passed through each other.
  std::size_t intersectionEdges = 0;
  /// Points moved across a gap, and the longest of these moves in model units.
  std::size_t closedGaps = 0;
  double largestGap = 0.0;
  /// Triangles whose winding was turned.
  std::size_t flippedTriangles = 0;
  /// Places where triangles still touch or pass through each other other than in common edges and points.
  std::size_t unresolvedContacts = 0;
  /// Entries of surfaces that have any, in the order of surfaces.
  std::vector<HiddenDetail> hidden;
  /// One entry for each two named surfaces that overlap, and for each surface that overlaps itself, sorted by `gives`
  /// and then by `keeps`. Areas in clusters do not count.
  std::vector<SharedArea> shared;
};

} // namespace atria
