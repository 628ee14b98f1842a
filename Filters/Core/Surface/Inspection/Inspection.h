// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

#include <string>
#include <vector>

namespace atria {

/// What a surface model holds, without changing or judging it. An edge is open where one triangle uses it,
/// non-manifold where three or more do. Edges count by places, not by point numbers; two triangles that meet
/// across two names are neighbors all the same, but an edge is open for a name where the name alone leaves
/// it open.
struct SurfaceSummary
{
  std::string name;
  std::size_t triangles = 0;
  std::size_t degenerate = 0; ///< triangles with two corners in one place, or without area; they make no edges
  double area = 0.0;
  Box3 bounds; ///< of the points its triangles use; empty without triangles
  std::size_t openEdges = 0;
  std::size_t nonManifoldEdges = 0;
};

struct Inspection
{
  std::vector<SurfaceSummary> surfaces; ///< in the order of the names, those without triangles too
  SurfaceSummary total;                 ///< of the model as a whole: its edges see all surfaces together
  std::size_t points = 0;               ///< different places triangles use
};

/// Summarizes a model. Points of equal coordinates are one. Throws Error for points that are not finite and indices out
/// of range. O(n log n).
Inspection inspect(const TriangleSurface& surface);

} // namespace atria
