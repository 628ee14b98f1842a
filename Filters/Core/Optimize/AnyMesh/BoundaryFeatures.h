// SPDX-License-Identifier: GPL-3.0-or-later
/// What the points on the boundary of any mesh are on, as far as the mesh itself tells.
#pragma once

#include "Quality/Faces/Geometry.h"
#include "Support/Buckets.h"
#include "Support/RunContext.h"

#include <array>
#include <vector>

namespace atria {

enum class BoundaryKind : std::uint8_t
{
  inside,  ///< not on the boundary
  surface, ///< on one smooth piece of it
  curve,   ///< on an edge that is kept
  corner   ///< where kept edges meet, end or turn, or the boundary is pointed
};

struct BoundaryFeatures
{
  /// Per point of the mesh. Points on the boundary that are in the same place, such as those on the two sides of a
  /// sheet, have one leader, the first of them, unless a cell has two of them. All others lead themselves.
  std::vector<Index> leaders;
  std::vector<BoundaryKind> kinds; ///< per leader
  /// Boundary faces by their number in the mesh, only one of those that have the same leaders; and the smooth piece of
  /// the boundary each belongs to.
  std::vector<Index> faces;
  std::vector<Index> charts;
  Buckets facesAbout; ///< by leader, into `faces`
  /// Edges that are kept, by the leaders of their ends.
  std::vector<std::array<Index, 2>> edges;
  Buckets edgesAbout; ///< by leader, into `edges`
};

/// An edge of the boundary is kept if other than two faces meet in it, if the normals of the two differ by more than
/// `featureAngle` (degrees), or if these are of different patches. A face that has been turned over within its plane,
/// as in a tangled mesh, makes no edge. `patches` gives the patch of each boundary face of the mesh, or is empty.
BoundaryFeatures findBoundaryFeatures(const FaceMesh& mesh, const CellFaces& cellFaces, std::span<const Index> patches,
                                      double featureAngle, const RunContext& context);

} // namespace atria
