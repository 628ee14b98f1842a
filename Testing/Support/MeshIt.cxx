// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/MeshIt.h"

namespace atria::testing {

Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options, int threads)
{
  const ThreadExecutor executor(threads);
  SilentMonitor silent;
  return meshIt(surface, grid, options, {executor, ProgressRange(silent)});
}

Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options,
              const RunContext& context)
{
  MesherOptions all;
  all.site.mode = DomainMode::bounds;
  all.site.bounds = grid.domain;
  all.sizes = grid;
  all.mesh = options;
  MeshedModel meshed = meshModel(surface, all, context, true);
  Meshed out;
  out.frame = meshed.sources->octree.frame();
  out.model = std::move(meshed.sources->model);
  out.octree = std::move(meshed.sources->octree);
  out.result = std::move(meshed);
  return out;
}

} // namespace atria::testing
