// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/Improvement/VertexDetachment.h"

namespace atria {

/// Two faces of an element that lie in one plane are made one where that gives a sound polygon (mergeCoplanarFaces). It
/// does not where their common edge is a waist of it. Points at such waists go to between those beside them, as far as
/// the elements about them let them.
void widenWaists(ImproverState& state, VertexDetachment& detachment);

} // namespace atria
