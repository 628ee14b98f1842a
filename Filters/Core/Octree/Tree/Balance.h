// SPDX-License-Identifier: GPL-3.0-or-later
/// Balances refined octants, so that sizes of neighbors differ by one level at most.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"

namespace atria {

/// Refines further until leaves in the domain that share a face, an edge or a corner differ by one level at most (2:1),
/// and at least `cellsPerLevel` leaves of a level lie between those of the next finer and of the next coarser one.
/// Octants outside the domain are not refined. With `families`, an octant is refined, also outside the domain, if one
/// of its siblings is. The result is the smallest such octree, which is unique. O(n log n).
void balance(RefinedSets& refined, const GridFrame& frame, const RunContext& context, int cellsPerLevel = 1,
             bool families = false);

} // namespace atria
