// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Divides triangles into pieces that are smooth in themselves, such as the sides of a box: neighbors are together
/// where they share an edge that no other triangle of their group has, and their planes differ by `degrees` at most.
/// Points at equal coordinates are one; winding does not matter; triangles of different `groups` are never together.
/// Returns the piece of each triangle, numbered from 0 in the order of their first triangles. O(n log n).
std::vector<Index> smoothPieces(std::span<const Vec3> points, std::span<const std::array<Index, 3>> triangles,
                                std::span<const Index> groups, double degrees);

} // namespace atria
