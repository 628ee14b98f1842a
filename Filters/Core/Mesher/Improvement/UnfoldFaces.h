// SPDX-License-Identifier: GPL-3.0-or-later
/// Unfolds faces of walls before layers are added.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Slides points along their surfaces and curves where a face of a wall is folded: where one of the triangles about the
/// mean of its points faces the other way, as beside the corner of an opening that a point is too close to. A folded
/// face covers what is none of its surface. Points of sheets are not split yet. Does nothing where no face is folded.
void unfoldFaces(DualMesh& mesh, VertexConstraints& constraints, const RunContext& context);

} // namespace atria
