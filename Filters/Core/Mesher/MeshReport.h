// SPDX-License-Identifier: GPL-3.0-or-later
/// Reports what a user should know of a mesh, whether one process or several made it.
#pragma once

#include "Mesher/DrawnModel.h"
#include "Mesher/MeshModel.h"
#include "Mesher/ModelStages.h"

namespace atria {

/// Sources of a mesh.
struct MeshSources
{
  /// The model as drawn, but standing on its ground.
  const GroundedInput& grounded;
  const DrawnModel& drawn;
  const SurfaceModel& model;
  const GridFrame& frame;
};

/// Completes the audit, and adds warnings, notes and names to a mesh that is along the model's axes.
/// \param metCellZones  One flag per surface: nonzero if elements are in the cell zone within it.
void reportMesh(const MeshSources& sources, const std::vector<char>& metCellZones, MeshedModel& out);

} // namespace atria
