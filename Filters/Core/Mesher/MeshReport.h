// SPDX-License-Identifier: GPL-3.0-or-later
/// Says of a mesh what a user should know, whether one process or several made it.
#pragma once

#include "Mesher/DrawnModel.h"
#include "Mesher/MeshModel.h"
#include "Mesher/ModelStages.h"

namespace atria {

/// What a mesh was made of.
struct MeshSources
{
  /// As drawn, but standing on its ground.
  const GroundedInput& grounded;
  const DrawnModel& drawn;
  const SurfaceModel& model;
  const GridFrame& frame;
};

/// Completes the audit, and adds warnings, notes and names to a mesh that is in the model.
/// \param metCellZones  By surface, whether elements are in the cell zone within it.
void reportMesh(const MeshSources& sources, const std::vector<char>& metCellZones, MeshedModel& out);

} // namespace atria
