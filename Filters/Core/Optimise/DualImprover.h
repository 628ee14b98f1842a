// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the mesh of a model valid and good at its boundary.
#pragma once

#include "Dual/DualMesher.h"
#include "Dual/DualVertices.h"
#include "Dual/FlatElements.h"
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
  /// See splitSheets.
  void splitPoints();
  /// Moves points where elements at the boundary fall short. Of those that cannot be made valid, flat ones are left
  /// out, and the vertices of the others may leave the curves and then the surfaces they should be on.
  void improve();

private:
  OptimiserReport optimiseOnce(int rings);
  bool removeFlat(const Flatness& flatness, const std::vector<char>* among);
  void renumber(const MeshRenumbering& numbers);
  void release(const std::vector<char>& bad, bool all);

  const Octree& octree_;
  const SurfaceModel& model_;
  VertexAnchors anchors_;
  DualMeshResult& result_;
  DualMesh& mesh_;
  const RunContext& context_;
  std::vector<Index> vertexOf_;
};

} // namespace atria
