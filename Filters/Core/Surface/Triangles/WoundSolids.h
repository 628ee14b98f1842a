// SPDX-License-Identifier: GPL-3.0-or-later
/// Solids of a model, told by how their triangles are wound: also where two of them share a face or an edge.
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

/// Per triangle the number of its solid; noIndex for those of none. A solid is closed: about each of its edges the
/// next triangle behind each of its triangles shows its back too. Triangles of two solids may coincide with their
/// fronts facing each other. Corners are numbers of points; points that coincide are to have the same number.
/// O(n log n).
std::vector<Index> findWoundSolids(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                   Front front);

} // namespace atria
