// SPDX-License-Identifier: GPL-3.0-or-later
/// Adds a layer where none was requested and elements cannot be valid without.
#pragma once

#include "Mesher/Improvement/VertexDetachment.h"

namespace atria {

/// Returns marks of the plain mesh's points that are to get a layer nobody requested: those of elements that are
/// concave at walls (findConcaveAtWalls) or have too few neighbors, and those of two rows of faces around them. The
/// layer tapers to nothing in the outer row. Empty if no point can have one.
std::vector<char> pointsToSupport(ImproverState& state);

/// Adds the layer at marked points. Sets the focus of the state to the cells that this changes.
void addSupport(ImproverState& state, const std::vector<char>& points);

/// Adds the layer where elements came to need it as points moved, and improves the surroundings, as long as fewer
/// points need it each time. Clears the focus of the state.
void supportMore(ImproverState& state, VertexDetachment& detachment);

} // namespace atria
