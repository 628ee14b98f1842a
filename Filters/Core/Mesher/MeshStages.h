// SPDX-License-Identifier: GPL-3.0-or-later
/// The stages of meshModel(), for callers that run some of them in another way.
#pragma once

#include "Mesher/DualMesher.h"
#include "Mesher/MeshModel.h"
#include "Mesher/ModelStages.h"

namespace atria {

/// The model in its grid, repaired.
struct PreparedModel
{
  SurfaceModel model;
  /// The model as drawn, but standing on its ground.
  GroundedInput grounded;
  /// Same as in MeshedModel.
  std::vector<std::string> inputWarnings;
  std::string sizingWarning;
  int maximumLevel = 0;
};

/// A prepared model and the octree that holds it.
struct ModelOctree : PreparedModel
{
  Octree octree;
};

/// A prepared model and the octants that it requires, balanced.
struct SizedModel : PreparedModel
{
  GridFrame frame;
  SizedOctants octants;
};

/// Places the model in its grid, repairs it, and sizes octants.
SizedModel sizeModel(const TriangleSurface& surface, const ModelOptions& options, StageClock& clock,
                     const RunContext& context);

/// Meshes the dual of an octree whose leaves know their pieces of the model, and reports how it differs from the model.
/// `kept` and `port` are as for makeDualMesh().
MeshedModel meshOctree(const PreparedModel& prepared, const Octree& octree, const MesherOptions& options,
                       DualStages* kept, MeshPort& port, StageClock& clock, const RunContext& context);

} // namespace atria
