// SPDX-License-Identifier: GPL-3.0-or-later
/// The layer where none was asked for, on surfaces that have elements that cannot be valid without.
#pragma once

#include "Mesher/Improvement/VertexDetachment.h"

namespace atria {

/// The points of the plain mesh, marked, that are to have a layer for which none was asked: those of elements that are
/// concave at walls (see findConcaveAtWalls) or have too few neighbors, and those of the faces around them, two faces
/// wide: in the last one the layer tapers to nothing. Empty where there are none that can have one.
std::vector<char> pointsToSupport(ImproverState& state);

/// Gives them the layer. The state's focus is on what this changes then.
void addSupport(ImproverState& state, const std::vector<char>& points);

/// Elements that came to need it as points moved get it, and what is about it is improved, as long as fewer points ask
/// for it each time. The state's focus is on nothing then.
void supportMore(ImproverState& state, VertexDetachment& detachment);

} // namespace atria
