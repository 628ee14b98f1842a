// SPDX-License-Identifier: GPL-3.0-or-later
/// A model meshed in a given domain.
#pragma once

#include "Mesher/DrawnModel.h"
#include "Mesher/MeshStages.h"

namespace atria::testing {

struct Meshed
{
  GridFrame frame;
  SurfaceModel model;
  Octree octree;
  DualMeshResult result;
  /// What the model was made of.
  GroundedInput grounded;
  const DualMesh& mesh() const { return result.mesh; }
  DrawnModel drawn(const RunContext& context) const
  {
    return drawnModel(grounded.surface, grounded.options.site, model.kinds, frame, context);
  }
};

Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options = {},
              int threads = 1);
Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options,
              const RunContext& context);

/// A randomSoup, all zones of it, in elements of 0.25 to 0.5 m.
Meshed meshSoup(unsigned seed, double sizeMid);

/// Those of such a run.
MesherOptions optionsIn(const GridOptions& grid, const DualMeshOptions& options);

} // namespace atria::testing
