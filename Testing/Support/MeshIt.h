// SPDX-License-Identifier: GPL-3.0-or-later
/// A model meshed in a given domain.
#pragma once

#include "Mesher/MeshModel.h"

namespace atria::testing {

struct Meshed
{
  GridFrame frame;
  SurfaceModel model;
  Octree octree;
  DualMeshResult result;
  const DualMesh& mesh() const { return result.mesh; }
};

Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options = {},
              int threads = 1);
Meshed meshIt(const TriangleSurface& surface, const GridOptions& grid, const DualMeshOptions& options,
              const RunContext& context);

/// Those of such a run.
MesherOptions optionsIn(const GridOptions& grid, const DualMeshOptions& options);

} // namespace atria::testing
