// SPDX-License-Identifier: GPL-3.0-or-later
/// Grows the layer on walls and sees to it that every element at the boundary is valid and good.
#pragma once

#include "Mesher/Improvement/VertexDetachment.h"

namespace atria {

struct ImprovedLayer
{
  LayerMesh layer;
  /// Vertices that are not where the model wants them, in rising order of points.
  std::vector<DetachedVertex> detached;
  /// Elements that checkMesh objects to unless they are made one with others, in order.
  std::vector<Index> failing;
};

/// The layers asked for; fewer at points where elements would not be valid. Without any asked for, the plain mesh made
/// valid; its elements may be concave then. ImproverStages.h has the stages in their order.
///
/// `vertexOf` gives for each point of the plain mesh the vertex of the anchors it stands for; points of one vertex are
/// in one place and stay together, and the one with its number, the leader, is one of them. The plain mesh's points
/// follow those of the layer's walls; where no layer is asked for, the plain mesh is taken.
ImprovedLayer improveLayer(const MeshingContext& context, const VertexClassification& classification,
                           const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                           const LayerOptions& options, const CurvedWallTargets& curvedWalls);

} // namespace atria
