// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"

namespace atria::testing {

Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options, int threads)
{
  const ThreadExecutor executor(threads);
  return meshIt(surface, grid, options, quietContext(executor));
}

Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options,
              const RunContext& context)
{
  StageCache cache;
  Meshed out;
  out.result = meshModel(surface, optionsIn(grid, options), context, &cache);
  out.frame = cache.sources()->octree.frame();
  out.model = cache.sources()->model;
  out.octree = cache.sources()->octree;
  return out;
}

MesherOptions optionsIn(const GridOptions& grid, const DualMeshOptions& options)
{
  MesherOptions all;
  all.site.mode = DomainMode::bounds;
  all.site.bounds = grid.domain;
  all.sizes = grid;
  all.mesh = options;
  return all;
}

} // namespace atria::testing
