// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Grid/GridFrame.h"

#include <span>
#include <vector>

namespace atria {

/// For each point the index of the first point that it is one with: itself, or an earlier kept point within `distance`
/// lattice units in each coordinate. O(n) on average.
std::vector<Index> weldPoints(std::span<const LatticePoint> points, std::int64_t distance);

} // namespace atria
