// SPDX-License-Identifier: GPL-3.0-or-later
/// Holds a model as triangles of named surfaces, as it was read.
#pragma once

#include "Support/Types.h"

#include <string>
#include <vector>

namespace atria {

/// Triangles of a model, each belonging to a named surface. No manifoldness is assumed; points may repeat. A triangle's
/// front is the side from which its points run counterclockwise.
struct TriangleSurface
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  /// Per triangle: an index into `names`, or beyond its end on sides of the domain (see TurnedSides.h).
  std::vector<Index> surfaceIds;
  std::vector<std::string> names;
};

/// Returns the sum of the triangles' areas. Throws Error if it is not finite, or if no triangle has area.
double areaOf(const TriangleSurface& surface);

} // namespace atria
