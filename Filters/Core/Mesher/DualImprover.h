// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the mesh of a model valid and good at its boundary.
#pragma once

#include "Dual/Vertices/DualVertices.h"
#include "Layer/BoundaryLayers.h"
#include "Mesher/DualMesher.h"
#include "Mesher/Improvement/LayerImprover.h"

namespace atria {

/// Changes the mesh of a result, and knows what its points stand for.
class DualImprover
{
public:
  /// Points of the result's mesh are the vertices of `anchors`.
  DualImprover(const Octree& octree, const SurfaceModel& model, TriangleTreeOnDemand& tree, VertexAnchors anchors,
               DualMeshResult& result, const RunContext& context);

  /// See unfoldFaces. Before points are split.
  void unfoldWalls();
  /// See splitSheets.
  void splitPoints();
  /// Grows layers on walls and makes the elements at the boundary valid (see LayerImprover), also where rules ask for
  /// none. Does nothing without rules.
  void growLayers(const std::vector<LayerRule>& rules, const CurvedWallTargets& curvedWalls);

private:
  bool straightenCurves(DualMesh& plain, const BoundaryGraph& graph);
  void reportReleased(const std::vector<ReleasedVertex>& released);

  const Octree& octree_;
  const SurfaceModel& model_;
  TriangleTreeOnDemand& tree_;
  VertexAnchors anchors_;
  DualMeshResult& result_;
  DualMesh& mesh_;
  const RunContext& context_;
  std::vector<Index> vertexOf_;
};

} // namespace atria
