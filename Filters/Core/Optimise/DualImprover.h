// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the mesh of a model valid and good at its boundary.
#pragma once

#include "Dual/DualMesher.h"
#include "Dual/DualVertices.h"
#include "Layer/BoundaryLayers.h"
#include "Optimise/Optimiser.h"

namespace atria {

/// Changes the mesh of a result, and knows what its points stand for.
class DualImprover
{
public:
  /// Points of the result's mesh are the vertices of `anchors`.
  DualImprover(const Octree& octree, const SurfaceModel& model, VertexAnchors anchors, DualMeshResult& result,
               const RunContext& context);

  /// Moves points where elements at the boundary fall short, along what they are on. The two sides of a sheet still are
  /// one. Elements all of whose points are on one plane of a sheet stay flat; the layer opens them.
  void improve();
  /// See splitSheets.
  void splitPoints();
  /// Grows layers on walls, moves points so that elements have room, and leaves the layer out where they have not.
  void growLayers(const std::vector<LayerRule>& rules);

private:
  void release(const DualMesh& mesh, const std::vector<char>& bad);
  bool isOnTurnedSide(Index vertex) const;
  LayerMesh growOptimised(const DualMesh& plain, const LayerWalls& walls, const LayerOptions& options);
  std::vector<ShortCell> optimiseLayer(LayerMesh& layer, const LayerWalls& walls, const LayerOptions& options,
                                       int rings);

  const Octree& octree_;
  const SurfaceModel& model_;
  VertexAnchors anchors_;
  DualMeshResult& result_;
  DualMesh& mesh_;
  const RunContext& context_;
  std::vector<Index> vertexOf_;
  /// By curve; empty unless the domain is turned.
  std::vector<char> onTurnedSide_;
};

} // namespace atria
