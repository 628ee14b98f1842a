// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/MeshIt.h"

#include "Octree/Refinement.h"

namespace atria::testing {

Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options, int threads)
{
  const ThreadExecutor executor(threads);
  SilentMonitor silent;
  const RunContext context{executor, ProgressRange(silent)};
  Box3 extent;
  for (const Vec3& p : surface.points)
  {
    extent.extend(p);
  }
  Meshed out;
  out.frame = makeGridFrame(grid, extent);
  out.model = makeSurfaceModel(surface, out.frame, {}, context);
  out.octree = buildOctree(out.model, out.frame, SizingOptions{}, context);
  StageClock clock;
  out.result = makeDualMesh(out.octree, out.model, options, clock, context);
  return out;
}

} // namespace atria::testing
