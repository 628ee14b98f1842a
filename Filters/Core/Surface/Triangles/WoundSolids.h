// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the solids of a model by the winding of their triangles, even if two of them share a face or an edge.
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

enum class Front
{
  outside, ///< fronts of triangles, from which their corners run counterclockwise, are outside of the solid
  inside
};

/// Returns the solid of each triangle; noIndex for triangles of none. In a closed solid, at each edge, the next
/// triangle behind each of its triangles shows its back too. Triangles of two solids may coincide with their fronts
/// facing each other. Corners are numbers of points; coincident points must have the same number. O(n log n).
std::vector<Index> findWoundSolids(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                   Front front);

} // namespace atria
