// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes the surfaces of a model: all stages in a row.
#pragma once

#include "Mesher/MeshOptions.h"
#include "Mesher/MeshResult.h"
#include "Support/RunContext.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <memory>

namespace atria {

struct ModelOctree;
struct OctreeSets;

/// Results that a run leaves for later ones: the stages up to layers. A later run takes those stages whose input and
/// options are the same, bit by bit; its mesh is that of a run without cache. An aborted run leaves the stages that it
/// has finished. Takes 150 to 200 bytes an element, including the copy of the mesh that layers are grown on.
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

  struct Stages; ///< used by meshModel()
  Stages& stages() { return *stages_; }

private:
  std::unique_ptr<Stages> stages_;
};

/// Meshes a model: places it in its grid, repairs it, sizes octants, and meshes their dual. The result depends neither
/// on threads nor on what `cache` holds. Throws Error if the options cannot be met, Aborted on demand.
///
/// The stages are sizeModel(), buildOctree() and meshOctree() in Mesher/MeshStages.h.
MeshedModel meshModel(const TriangleSurface& surface, const MesherOptions& options, const RunContext& context,
                      StageCache* cache = nullptr);

/// The same for given octants, which are balanced if they are not. The options for sizes and domain are not used.
MeshedModel meshModel(const TriangleSurface& surface, const OctreeSets& octants, const MesherOptions& options,
                      const RunContext& context, StageCache* cache = nullptr);

/// Estimates the elements that the requested layers add to the mesh, in all zones: roughly, as sheets have layers on
/// both sides. Builds the octree. Throws as meshModel() does.
std::size_t estimateLayerElements(const TriangleSurface& surface, const MesherOptions& options,
                                  const RunContext& context);

} // namespace atria
