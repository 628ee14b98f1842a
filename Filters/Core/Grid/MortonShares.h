// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/RunContext.h"
#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// The share of each place, 0 to shares - 1. Shares are ranges along the Morton order of places in the cube about them,
/// and of equal length within one; the first ones are the longer. Places of one key are in the order of their numbers.
/// The same for any number of threads. \pre shares > 0.
std::vector<Index> divideAlongMorton(std::span<const Vec3> places, std::size_t shares, const RunContext& context);

} // namespace atria
