// SPDX-License-Identifier: GPL-3.0-or-later
/// Reports how meshing changes a model, without a mesh.
#pragma once

#include "Mesher/ModelOptions.h"
#include "Support/RunContext.h"
#include "Surface/Repair/RepairReport.h"
#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Places a model in its grid and repairs it. Returns the changes. Throws Error if the options cannot be met, Aborted
/// on demand.
SurfaceRepairReport reportRepair(const TriangleSurface& surface, const ModelOptions& options,
                                 const RunContext& context);

} // namespace atria
