// SPDX-License-Identifier: GPL-3.0-or-later
/// From the surfaces of a model to its mesh: all stages in a row.
#pragma once

#include "Mesher/DualMesher.h"
#include "Mesher/ModelOptions.h"

#include <memory>

namespace atria {

struct MesherOptions : ModelOptions
{
  DualMeshOptions mesh;
};

/// What a mesh was made from.
struct MeshSources
{
  SurfaceModel model;
  Octree octree;
};

struct MeshedModel : DualMeshResult
{
  /// Names of the surfaces; tags of boundary faces from their number on are bare sides of the domain, by number.
  std::vector<std::string> names;
  /// Of each surface; empty where all are walls.
  std::vector<SurfaceKind> kinds;
  SurfaceRepairReport repair;
  /// What a user should know of the domain and of cell zones, a sentence each; see checkDomain.
  std::vector<std::string> inputWarnings;
  /// What sizes had to be left out to keep to the limit of elements; empty if nothing.
  std::string sizingWarning;
  /// The level of the finest octants.
  int maximumLevel = 0;
  /// Names of the stages and the seconds that each took.
  std::vector<std::pair<std::string, double>> stages;
  /// Where they were asked for.
  std::unique_ptr<MeshSources> sources;
};

/// Places the model in its grid, repairs it, sizes octants, and meshes their dual. With `keepSources` the result holds
/// octree and repaired model too, which else are freed. The result does not depend on threads. Throws Error where the
/// options cannot be met, Aborted on demand.
MeshedModel meshModel(const TriangleSurface& surface, const MesherOptions& options, const RunContext& context,
                      bool keepSources = false);

/// The same for octants that are given, which are balanced if they are not. Of the options those of sizes and domain
/// are not used.
MeshedModel meshModel(const TriangleSurface& surface, OctreeSets octants, const MesherOptions& options,
                      const RunContext& context);

/// Elements that the layers asked for add to the mesh, all zones counted: roughly, as sheets have layers on both sides.
/// Builds the octree. Throws as meshModel().
std::size_t estimateLayerElements(const TriangleSurface& surface, const MesherOptions& options,
                                  const RunContext& context);

} // namespace atria
