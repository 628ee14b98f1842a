// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <string>
#include <vector>

namespace atria {

/// The model as triangles, each belonging to a named surface. No manifoldness is assumed; points may
/// repeat. A triangle's front is the side from which its points run counter-clockwise.
struct TriangleSurface
{
  std::vector<Vec3> points;
  std::vector<std::array<Index, 3>> triangles;
  /// Per triangle, an index into `names`; beyond them on sides of the domain (see TurnedSides.h).
  std::vector<Index> surfaceIds;
  std::vector<std::string> names;
};

/// The sum of the triangles' areas. Throws Error where it is not finite, or no triangle has one.
double areaOf(const TriangleSurface& surface);

} // namespace atria
