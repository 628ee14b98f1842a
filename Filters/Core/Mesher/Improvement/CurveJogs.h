// SPDX-License-Identifier: GPL-3.0-or-later
/// Straightens curves of the mesh that go around a face.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Layer/BoundaryGraph.h"

namespace atria {

/// Changes made by removeJogs().
struct RemovedJogs
{
  Index faces = 0;
  std::vector<Index> freed; ///< points that left a curve, those of one vertex one after the other
};

/// Straightens curves where they go around a face, a jog: three edges of the face are on the curve, and no place of its
/// points on the curve gives it an area. The face then belongs to the surface beyond the curve, and its inner points
/// slide on that. Jogs arise where a corner between two walls reaches just past an edge of the grid. Both sides of a
/// sheet change together. Sides of the domain stay as they are.
/// \param mesh      A mesh whose sheets are split.
/// \param vertexOf  The vertex of each point. Linear in the boundary faces.
RemovedJogs removeJogs(DualMesh& mesh, const BoundaryGraph& graph, const std::vector<Index>& vertexOf,
                       VertexClassification& classification);

} // namespace atria
