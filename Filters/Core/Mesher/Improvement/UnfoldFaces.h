// SPDX-License-Identifier: GPL-3.0-or-later
/// Unfolds faces of walls before layers are added.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Slides points along their surfaces and curves until no wall face is folded. A face is folded if one of the triangles
/// around the mean of its points faces the other way, as beside the corner of an opening that a point is too close to.
/// It would cover more than its surface. Call it before points of sheets are split.
void unfoldFaces(DualMesh& mesh, VertexConstraints& constraints, const RunContext& context);

} // namespace atria
