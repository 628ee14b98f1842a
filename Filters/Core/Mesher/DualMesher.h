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
  /// Everything found so far; its mesh is empty.
  DualMeshResult found;
  ClassifiedMesh mesh;
  SeenModel seen;
};

/// Parts of the model that air may reach.
struct ReachedStage
{
  UnreachedParts parts;
  /// Null if air may reach all of the model.
  std::unique_ptr<ReachedModel> model;
  /// Empty if `model` is null.
  WholeZones zones;

  /// Returns `whole`, the context of the whole model, with the model that air may reach.
  MeshingContext in(const MeshingContext& whole) const { return model ? model->in(whole) : whole; }
};

/// Results that a run leaves for later ones on the same octree and model, which must not be moved in memory.
struct DualStages
{
  std::optional<TriangleTreeOnDemand> tree;
  KeptStage<ZoneOptions, ReachedStage> reached;
  KeptStage<CrossingOptions, CrossedGrid> grid;
  KeptStage<ElementOptions, PlainDual> plain;
};

/// Makes the dual of an octree whose leaves know their pieces of the model. The octree and its model are along the
/// grid's axes (`GridFrame::placement`), the mesh is along the model's.
/// \param kept   Stages whose options are unchanged are taken from here, and the others are left here. If null, each
///               stage is freed as soon as it is used.
/// \param drawn  Tells which zones are inside of closed bodies; if null, only the faces of zones do.
/// \param port   Agrees with the processes that make other parts of the mesh.
/// \throws Error if no zone is left, Aborted on demand.
DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& context, DualStages* kept, const DrawnModel* drawn,
                            MeshPort& port);

/// The same in one process.
DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& context, DualStages* kept = nullptr,
                            const DrawnModel* drawn = nullptr);

} // namespace atria
