// SPDX-License-Identifier: GPL-3.0-or-later
/// Brings valid elements within the angles that solvers do well with.
#pragma once

#include "Mesher/Improvement/VertexDetachment.h"

namespace atria {

/// Runs the stages for angles. Vertices at faces that stay beyond the largest angle leave curves and surfaces.
void straighten(ImproverState& state, VertexDetachment& detachment);

/// Does the same if a mesh with single layers has such faces.
void straightenWhereNeeded(ImproverState& state, VertexDetachment& detachment);

} // namespace atria
