// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/MeshIt.h"

#include "Octree/Sizing/Refinement.h"

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
  Box3 extent;
  for (const Vec3& p : surface.points)
  {
    extent.extend(p);
  }
  Meshed out;
  out.frame = makeGridFrame(grid, extent);
  out.model = makeSurfaceModel(surface, out.frame, {}, context.part(0.0, 0.1));
  out.octree = buildOctree(out.model, out.frame, SizingOptions{}, context.part(0.1, 0.4));
  StageClock clock;
  out.result = makeDualMesh(out.octree, out.model, options, clock, context.part(0.4, 1.0));
  return out;
}

} // namespace atria::testing
