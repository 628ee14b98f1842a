// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Octree/Octree.h"
#include "Support/RunContext.h"

namespace atria {

/// Refines further until leaves in the domain that share a face, an edge or a corner differ by one level at most (2:1).
/// Octants outside the domain are not refined. The smallest such octree, unique. O(n log n).
void balance(RefinedSets& refined, const GridFrame& frame, const RunContext& context);

} // namespace atria
