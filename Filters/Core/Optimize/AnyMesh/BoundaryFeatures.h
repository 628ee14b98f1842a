// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the edges, corners and smooth pieces of the boundary of any mesh.
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
  surface, ///< on one smooth piece of the boundary
  curve,   ///< on a kept edge
  corner   ///< kept edges meet, end or turn there, or the boundary is pointed or touches itself
};

struct BoundaryFeatures
{
  /// One entry per point of the mesh. Boundary points in one position, such as those on the two sides of a sheet, have
  /// the first of them as their leader, unless a cell has two of them. All other points lead themselves.
  std::vector<Index> leaders;
  std::vector<BoundaryKind> kinds; ///< one entry per point, valid for leaders
  /// Boundary faces by their numbers in the mesh, and the smooth piece of the boundary that each belongs to. Faces with
  /// the same leaders are listed once.
  std::vector<Index> faces;
  std::vector<Index> charts;
  Buckets facesAbout; ///< one list per leader, of indices into `faces`
  /// Kept edges, by the leaders of their ends.
  std::vector<std::array<Index, 2>> edges;
  Buckets edgesAbout; ///< one list per leader, of indices into `edges`
};

/// Finds the features of a mesh's boundary. An edge of the boundary is kept if
/// - other than two faces meet in it,
/// - the normals of its two faces differ by more than `featureAngle` (degrees), or
/// - its two faces belong to different patches.
/// A face that is turned over in its plane, as in a tangled mesh, makes no edge. `patches` has one entry per boundary
/// face of the mesh: its patch; empty if all are in one.
BoundaryFeatures findBoundaryFeatures(const FaceMesh& mesh, const CellFaces& cellFaces, std::span<const Index> patches,
                                      double featureAngle, const RunContext& context);

} // namespace atria
