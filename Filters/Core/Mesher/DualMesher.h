// SPDX-License-Identifier: GPL-3.0-or-later
/// From octree and model to mesh.
#pragma once

#include "Dual/Displacement/DisplacedGrid.h"
#include "Dual/Zones/BoundaryGaps.h"
#include "Dual/Zones/Leaks.h"
#include "Dual/Zones/Rooms.h"
#include "Mesher/DualImprover.h"
#include "Mesher/KeptStage.h"
#include "Mesher/RoomReport.h"
#include "Support/StageClock.h"

namespace atria {

/// What the grid's crossings depend on beyond octree and model.
struct CrossingOptions
{
  /// Cracks beside boundary edges that are no wider than this part of the octants there are closed; 0 closes none.
  /// Wider ones are open where an edge of the grid passes.
  double crackTolerance = 0.5;
};

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

struct DualMeshOptions : CrossingOptions, ZoneOptions, WallOptions
{
};

/// Something the mesh could not follow, or that a user should know of it.
struct Diagnostic
{
  enum Kind : std::uint8_t
  {
    mergedSheets,      ///< an octree edge is cut more than once: the sheets there became one
    unresolvedFeature, ///< pieces that do not meet share a vertex, which is not on all of them
    leakPath,          ///< a way from a sealed seed to the outside
    closedCrack,       ///< a gap beside a boundary edge, narrower than an octant, that no octree edge passes
    openCrack,         ///< one that octree edges pass
    detachedVertex,    ///< a vertex that is not where the model wants it, as no valid element could be there
    cluster,           ///< an octant with more pieces of the model than it can show; of its merged sheets and features
                       ///< nothing else is told
    leftOutElement     ///< an element at a wall that is not in the mesh, as it could not be made valid: its middle
  };
  Kind kind;
  Vec3 begin;
  Vec3 end;
  /// An element beside it; noIndex for a leak of a zone that is not meshed.
  Index element;
  /// How wide a gap is: a leak at its narrowest place, a crack at its widest. Of an element left out, the edge of a
  /// cube of its volume. 0 for the other kinds.
  double width = 0.0;
  /// The points of a line between its begin and end, in order.
  std::vector<Vec3> between = {};
};
inline constexpr std::array<const char*, 8> diagnosticNames{"MergedSheets", "UnresolvedFeature", "LeakPath",
                                                            "ClosedCrack",  "OpenCrack",         "DetachedVertex",
                                                            "Cluster",      "LeftOutElement"};

struct DualMeshResult
{
  DualMesh mesh;
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
};

/// The octree's grid: its points, what is ahead of boundary edges, and what cuts its edges.
struct CrossedGrid
{
  CrossedGrid(const CrossingOptions& options, StageClock& clock, const MeshingContext& context);

  GridPoints points;
  BoundaryGaps gaps;
  DisplacedGrid displaced; ///< of these points
};

/// The dual before walls are improved and have layers, and what was found on the way.
struct PlainDual
{
  /// Without a mesh.
  DualMeshResult found;
  ClassifiedMesh mesh;
};

/// What runs leave for later ones on the same octree and model, where they are.
struct DualStages
{
  std::optional<TriangleTreeOnDemand> tree;
  KeptStage<CrossingOptions, CrossedGrid> grid;
  KeptStage<ZoneOptions, PlainDual> plain;
};

/// The dual of an octree whose leaves know their pieces of the model. The octree and its model are along the grid's
/// axes (`GridFrame::placement`), the mesh is along the model's. Stages whose options are those of the run before are
/// taken from `kept`, if that is given, and the others left there; else each is freed as soon as it is used. Throws
/// Error where no zone is left, Aborted on demand.
DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& context, DualStages* kept = nullptr);

} // namespace atria
