// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures how far a mesh's patches and the model's surfaces are from each other.
#pragma once

#include "Audit/AuditResult.h"
#include "Audit/SurfaceSamples.h"
#include "Dual/Mesh/OwnElements.h"

namespace atria {

/// Returns one entry per surface: the distances that are largest over the local element size, along the grid's axes.
/// \param samples  Samples of the surfaces that this process took.
/// The result does not depend on threads. O(faces · log (triangles + faces)).
std::vector<SurfaceDistances> measureDistances(const DualMesh& mesh, const std::vector<SurfaceSample>& samples,
                                               const OwnElements& part, const MeshingContext& context);

} // namespace atria
