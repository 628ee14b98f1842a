// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the mesh of a model valid and good at its boundary.
#pragma once

#include "Dual/DualMesher.h"
#include "Dual/DualVertices.h"
#include "Dual/FlatElements.h"
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

  /// Leaves out elements that lie flat in the boundary, and those that do once these are gone.
  void removeFlat();
  /// Moves points where elements at the boundary fall short. The two sides of a sheet still are one. Vertices of
  /// elements that cannot be made valid may leave the curves they should be on.
  void improve();
  /// See splitSheets.
  void splitPoints();
  /// Grows layers on walls, moves points so that elements have room, and leaves the layer out where they have not.
  void growLayers(const std::vector<LayerRule>& rules);

private:
  bool removeFlat(const Flatness& flatness, const std::vector<char>* among);
  void renumber(const MeshRenumbering& numbers);
  void release(const DualMesh& mesh, const std::vector<char>& bad, bool all);
  LayerMesh growOptimised(const DualMesh& plain, const LayerWalls& walls, const LayerOptions& options);
  OptimiserReport optimiseLayer(LayerMesh& layer, const LayerWalls& walls, const LayerOptions& options,
                                int rings);

  const Octree& octree_;
  const SurfaceModel& model_;
  VertexAnchors anchors_;
  DualMeshResult& result_;
  DualMesh& mesh_;
  const RunContext& context_;
  std::vector<Index> vertexOf_;
};

} // namespace atria
