// SPDX-License-Identifier: GPL-3.0-or-later
/// From octree and model to mesh.
#pragma once

#include "Audit/MeshAudit.h"
#include "Dual/Mesh/MetSides.h"
#include "Dual/Zones/Leaks.h"
#include "Dual/Zones/UnreachedParts.h"
#include "Dual/Zones/WholeZones.h"
#include "Mesher/KeptStage.h"
#include "Mesher/PlainDual.h"
#include "Mesher/RoomReport.h"

namespace atria {

struct DrawnModel;

/// What is meshed of it.
struct ZoneOptions
{
  ZoneRule zoneRule = ZoneRule::outside;
  /// Along the model's axes.
  std::vector<Vec3> seeds;
  /// Points in zones that should be closed: see findLeaks.
  std::vector<Vec3> sealedSeeds;
  RoomOptions rooms = {};
};

/// The seeds that the rule asks for.
inline std::vector<Vec3> seedsOf(const ZoneOptions& options)
{
  return options.zoneRule == ZoneRule::seeds ? options.seeds : std::vector<Vec3>();
}

struct DualMeshOptions : CrossingOptions, ZoneOptions, WallOptions
{
};

struct DualMeshResult
{
  DualMesh mesh;
  /// By tag of boundary faces; see findMetSides.
  std::vector<MetSides> metSides;
  std::vector<Diagnostic> diagnostics;
  /// Zones found, and which of them the mesh keeps; `zones` of the mesh are indices into these.
  std::vector<char> keptZones;
  std::vector<ZoneSummary> zones;
  /// In the order of the diagnostics of their kind.
  std::vector<Leak> leaks;
  /// Empty without rules for layers.
  LayerReport layers = {};
  /// Empty where no surface is a face zone. `rooms` of the mesh are indices into its rooms.
  RoomReport rooms = {};
  /// Without what was drawn, until it is completed: see Mesher/AuditReport.h.
  MeshAudit audit = {};
};

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

/// Puts mesh and diagnostics back along the model's axes.
void placeInModel(DualMeshResult& result, const Placement& placement, const RunContext& context);

/// The dual of an octree whose leaves know their pieces of the model. The octree and its model are along the grid's
/// axes (`GridFrame::placement`), the mesh is along the model's. Stages whose options are those of the run before are
/// taken from `kept`, if that is given, and the others left there; else each is freed as soon as it is used. `drawn`
/// tells which zones are inside of closed bodies; without it only their faces do. Throws Error where no zone is left,
/// Aborted on demand.
DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& context, DualStages* kept = nullptr,
                            const DrawnModel* drawn = nullptr);

} // namespace atria
