// SPDX-License-Identifier: GPL-3.0-or-later
/// The layer where none was asked for, at elements that cannot be valid without.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

namespace atria {

/// Gives a layer to elements at walls for which none was asked: to those that are concave at walls (see
/// findConcaveAtWalls), and to those with too few neighbors. The state's focus is on what this changes then. Returns
/// whether there were any that can have one.
bool addSupport(ImproverState& state);

/// Gives a layer to the walls of all elements that have a point of one of some cells, or a point above it.
void widenSupport(ImproverState& state, const std::vector<ShortCell>& cells);

} // namespace atria
