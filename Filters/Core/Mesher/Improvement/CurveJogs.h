// SPDX-License-Identifier: GPL-3.0-or-later
/// Straightens curves that go around a face of the mesh.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Layer/BoundaryGraph.h"

namespace atria {

/// What straightening changed.
struct RemovedJogs
{
  Index faces = 0;
  std::vector<Index> freed; ///< points that left a curve, those of one vertex one after the other
};

/// Straightens chains of edges on curves where they go round a face: three of its edges are on the curve then, and it
/// is flat wherever its points are on that. It becomes one of the surface beyond the curve, whose charts its inner
/// points are on then. So it is where a corner between two walls reaches just past an edge of the grid, and a grid
/// point went there. The two sides of a sheet go together; sides of the domain are left alone.
///
/// `mesh` has its sheets split; `vertexOf` gives the vertex of each point. Linear in the faces of the boundary.
RemovedJogs removeJogs(DualMesh& mesh, const BoundaryGraph& graph, const std::vector<Index>& vertexOf,
                       VertexClassification& classification);

} // namespace atria
