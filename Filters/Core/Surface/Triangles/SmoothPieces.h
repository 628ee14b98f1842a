// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides triangles into smooth pieces.
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Returns the smooth piece of each triangle, such as the sides of a box, numbered from 0 in the order of their first
/// triangles. Neighbors are together if they share an edge that no other triangle of their group has, and if their
/// planes differ by at most `degrees`. Points at equal coordinates are merged, and winding does not matter. Triangles
/// of different `groups` are never together. O(n log n).
std::vector<Index> smoothPieces(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                std::span<const Index> groups, double degrees);

} // namespace atria
