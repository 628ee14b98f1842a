// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/MeshIt.h"
#include "Support/QuietContext.h"
#include "Support/Shapes.h"

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
  out.grounded = cache.sources()->grounded;
  return out;
}

Meshed meshSoup(unsigned seed, double sizeMid)
{
  GridOptions grid;
  grid.domain = {Vec3::Constant(-6.3), Vec3::Constant(6.1)};
  grid.sizeMin = 0.25;
  grid.sizeMid = sizeMid;
  grid.sizeMax = 0.5;
  DualMeshOptions options;
  options.zoneRule = ZoneRule::all;
  return meshIt(randomSoup(seed), grid, options);
}

MesherOptions optionsIn(const GridOptions& grid, const DualMeshOptions& options)
{
  MesherOptions all;
  all.site.mode = DomainMode::bounds;
  all.site.bounds = grid.domain;
  all.sizes = grid;
  all.sizing.hexahedra = options.hexahedra;
  all.mesh = options;
  return all;
}

} // namespace atria::testing
