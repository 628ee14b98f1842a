// SPDX-License-Identifier: GPL-3.0-or-later
/// From the surfaces of a model to its mesh: all stages in a row.
#pragma once

#include "Domain/GroundReport.h"
#include "Mesher/DualMesher.h"
#include "Mesher/ModelOptions.h"

#include <memory>

namespace atria {

struct MesherOptions : ModelOptions
{
  DualMeshOptions mesh;
};

/// The model in its grid, repaired, and the octree that holds it.
struct ModelOctree
{
  SurfaceModel model;
  Octree octree;
  /// As in MeshedModel.
  std::vector<std::string> inputWarnings;
  std::string sizingWarning;
  /// What the model was made of: as drawn, but standing on its ground.
  GroundedInput grounded;
};

/// What runs leave for later ones: the stages up to layers. A later run takes from it those whose input and options are
/// the same, bit by bit; its mesh is that of a run without. It may be left with what an aborted run has finished.
/// 150 to 200 bytes an element, the copy of the mesh that layers are grown on among them.
class StageCache
{
public:
  StageCache();
  ~StageCache();
  StageCache(const StageCache&) = delete;
  StageCache& operator=(const StageCache&) = delete;

  void clear();
  /// Null before the first run.
  const ModelOctree* sources() const;

  struct Stages; ///< of meshModel()
  Stages& stages() { return *stages_; }

private:
  std::unique_ptr<Stages> stages_;
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
  /// How the mesh differs from the model, a sentence each; see warningsOf() in Mesher/AuditReport.h.
  std::vector<std::string> auditWarnings;
  /// What sizes had to be left out to keep to the limit of elements; empty if nothing.
  std::string sizingWarning;
  /// How bodies stand on the ground; what there is to say of it is among `inputWarnings` and `notes`.
  GroundReport ground;
  /// What was done with the model, or is as it was drawn, a sentence each.
  std::vector<std::string> notes;
  /// The level of the finest octants.
  int maximumLevel = 0;
  /// Names of the stages and the seconds that each took.
  std::vector<std::pair<std::string, double>> stages;
};

/// Places the model in its grid, repairs it, sizes octants, and meshes their dual. The result depends neither on
/// threads nor on what `cache` holds. Throws Error where the options cannot be met, Aborted on demand.
MeshedModel meshModel(const TriangleSurface& surface, const MesherOptions& options, const RunContext& context,
                      StageCache* cache = nullptr);

/// The same for octants that are given, which are balanced if they are not. Of the options those of sizes and domain
/// are not used.
MeshedModel meshModel(const TriangleSurface& surface, const OctreeSets& octants, const MesherOptions& options,
                      const RunContext& context, StageCache* cache = nullptr);

/// Elements that the layers asked for add to the mesh, all zones counted: roughly, as sheets have layers on both sides.
/// Builds the octree. Throws as meshModel().
std::size_t estimateLayerElements(const TriangleSurface& surface, const MesherOptions& options,
                                  const RunContext& context);

} // namespace atria
