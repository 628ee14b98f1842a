// SPDX-License-Identifier: GPL-3.0-or-later
/// Summarizes a surface model: triangles, area, bounds, open and non-manifold edges.
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

#include <string>
#include <vector>

namespace atria {

/// Contents of one surface or of a whole model, neither changed nor judged. An edge is open if one triangle uses it and
/// non-manifold if three or more do. Edges count by places, not by point numbers. Two triangles that meet across two
/// names are neighbors, but the edge is open for a name whose own triangles leave it open.
struct SurfaceSummary
{
  std::string name;
  std::size_t triangles = 0;
  std::size_t degenerate = 0; ///< triangles with two corners in one place, or without area; they make no edges
  double area = 0.0;
  Box3 bounds; ///< bounds of the points its triangles use; empty without triangles
  std::size_t openEdges = 0;
  std::size_t nonManifoldEdges = 0;
};

struct Inspection
{
  std::vector<SurfaceSummary> surfaces; ///< in the order of the names, those without triangles too
  SurfaceSummary total;                 ///< sums over the model as a whole: its edges see all surfaces together
  std::size_t points = 0;               ///< number of different places that triangles use
};

/// Summarizes a model. Points of equal coordinates are merged. Throws Error for points that are not finite and for
/// indices out of range. O(n log n).
Inspection inspect(const TriangleSurface& surface);

} // namespace atria
