// SPDX-License-Identifier: GPL-3.0-or-later
/// The layer where none was asked for, on surfaces that have elements that cannot be valid without.
#pragma once

#include "Mesher/Improvement/VertexDetachment.h"

namespace atria {

/// Returns marks of the plain mesh's points that are to get a layer nobody requested: those of elements that are
/// concave at walls (findConcaveAtWalls) or have too few neighbors, and those of two rows of faces around them. The
/// layer tapers to nothing in the outer row. Empty if no point can have one.
std::vector<char> pointsToSupport(ImproverState& state);

/// Gives them the layer. The state's focus is on what this changes then.
void addSupport(ImproverState& state, const std::vector<char>& points);

/// Elements that came to need it as points moved get it, and what is about it is improved, as long as fewer points ask
/// for it each time. The state's focus is on nothing then.
void supportMore(ImproverState& state, VertexDetachment& detachment);

} // namespace atria
