// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides places into shares that are compact in space.
#pragma once

#include "Support/RunContext.h"
#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Returns the share of each place, 0 to shares - 1. Shares are ranges along the Morton order of the places in their
/// bounding cube. Their lengths differ by one at most; the first ones are the longer. Places with the same key are
/// ordered by number. The result is the same for any number of threads. `shares` must be above 0.
std::vector<Index> divideAlongMorton(std::span<const Vec3> places, std::size_t shares, const RunContext& context);

} // namespace atria
