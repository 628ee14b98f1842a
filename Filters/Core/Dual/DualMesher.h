// SPDX-License-Identifier: GPL-3.0-or-later
/// From octree and model to mesh.
#pragma once

#include "Dual/DualMesh.h"
#include "Dual/Zones.h"
#include "Support/StageClock.h"

namespace atria {

struct DualMeshOptions
{
  ZoneRule zoneRule = ZoneRule::outside;
  /// Along the model's axes.
  std::vector<Vec3> seeds;
};

/// Something the mesh could not follow.
struct Diagnostic
{
  enum Kind : std::uint8_t
  {
    mergedSheets,     ///< an octree edge is cut more than once: the sheets there became one
    unresolvedFeature ///< pieces that do not meet share a vertex, which is not on all of them
  };
  Kind kind;
  Vec3 begin;
  Vec3 end;
  /// An element beside it.
  Index element;
};
inline constexpr std::array<const char*, 2> diagnosticNames{"MergedSheets", "UnresolvedFeature"};

struct DualMeshResult
{
  DualMesh mesh;
  std::vector<Diagnostic> diagnostics;
  /// Zones found, and which of them the mesh keeps; `zones` of the mesh are indices into these.
  std::vector<char> keptZones;
};

/// The dual of an octree whose leaves know their pieces of the model. The octree and its model are along the grid's
/// axes
/// (`GridFrame::placement`), the mesh is along the model's. Throws Error where no zone is left, Aborted on
/// demand.
DualMeshResult makeDualMesh(const Octree& octree, const SurfaceModel& model, const DualMeshOptions& options,
                            StageClock& clock, const RunContext& context);

} // namespace atria
