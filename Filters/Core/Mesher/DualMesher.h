// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes an octree: all stages after it.
#pragma once

#include "Audit/MeshAudit.h"
#include "Dual/Zones/UnreachedParts.h"
#include "Dual/Zones/WholeZones.h"
#include "Mesher/KeptStage.h"
#include "Mesher/MeshResult.h"
#include "Mesher/PlainDual.h"

namespace atria {

struct DrawnModel;
class MeshPort;

/// The dual before walls are improved and have layers, and what was found on the way.
struct PlainDual
{
  /// Without a mesh.
  DualMeshResult found;
  ClassifiedMesh mesh;
  SeenModel seen;
};

/// What of the model air may reach.
struct ReachedStage
{
  UnreachedParts parts;
  /// Null where that is all of it.
  std::unique_ptr<ReachedModel> model;
  /// Empty there.
  WholeZones zones;

  /// `whole` is of all of the model.
  MeshingContext in(const MeshingContext& whole) const { return model ? model->in(whole) : whole; }
};

/// What runs leave for later ones on the same octree and model, where they are.
struct DualStages
{
  std::optional<TriangleTreeOnDemand> tree;
  KeptStage<ZoneOptions, ReachedStage> reached;
  KeptStage<CrossingOptions, CrossedGrid> grid;
  KeptStage<ZoneOptions, PlainDual> plain;
};

/// Makes the dual of an octree whose leaves know their pieces of the model. The octree and its model are along the
/// grid's axes (`GridFrame::placement`), the mesh is along the model's. `drawn` tells which zones are inside of closed
/// bodies; without it only their faces do. Stages whose options are those of the run before are taken from `kept`, and
/// the others left there; without it each is freed as soon as it is used. `port` agrees with the processes that make
/// other parts of the mesh. Throws Error if no zone is left, Aborted on demand.
DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& context, DualStages* kept, const DrawnModel* drawn,
                            MeshPort& port);

/// The same in one process.
DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& context, DualStages* kept = nullptr,
                            const DrawnModel* drawn = nullptr);

} // namespace atria
