// SPDX-License-Identifier: GPL-3.0-or-later
/// Brings valid elements within the angles that solvers do well with.
#pragma once

#include "Mesher/Improvement/VertexDetachment.h"

namespace atria {

/// Vertices at faces that stay beyond the largest angle leave their curves, and their surfaces by a little.
void straighten(ImproverState& state, VertexDetachment& detachment);

/// The same where single layers have such faces.
void straightenWhereNeeded(ImproverState& state, VertexDetachment& detachment);

} // namespace atria
