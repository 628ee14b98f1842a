// SPDX-License-Identifier: GPL-3.0-or-later
/// Grows the layer on walls, and makes every element at the boundary valid and good.
#pragma once

#include "Layer/LayerCoverage.h"
#include "Mesher/Improvement/CurvedWalls.h"
#include "Mesher/Improvement/VertexDetachment.h"

#include <optional>

namespace atria {

struct ImprovedLayer
{
  LayerMesh layer;
  /// Vertices that are not where the model wants them, sorted by point.
  std::vector<DetachedVertex> detached;
  /// Elements that fail checkMesh unless they are merged with others, sorted.
  std::vector<Index> failing;
  /// Sizes beside walls in the final plain mesh; see sizesBesideWalls.
  std::vector<double> wallSizes;
};

/// Runs all stages except crease sheets, in two parts. Another improver may take over the state of points in between.
class LayerImprover
{
public:
  /// Grows the layer. Vertices in `away` are not where the model wants them; see VertexDetachment.
  LayerImprover(ImproverState& state, const CurvedWallTargets& curvedWalls,
                const std::vector<DetachedVertex>& away = {});

  /// Makes elements sound, with one layer on walls.
  void improveWhole();
  /// Divides the layer, and makes angles small.
  void finish();
  /// Returns the vertices that are not where the model wants them, sorted by point.
  const std::vector<DetachedVertex>& detached() const { return detachment_.detached(); }

private:
  ImproverState& state_;
  MeshingContext whole_;
  CurvedWallTargets wanted_;
  VertexDetachment detachment_;
  std::optional<CurvedWalls> curved_;
};

/// Returns the elements that fail checkMesh unless they are merged with others, sorted.
std::vector<Index> findFailing(ImproverState& state);

/// Adds the requested layers, fewer at points where elements would not be valid. If none is requested, makes the plain
/// mesh valid; its elements may stay concave. ImproverStages.h lists the stages.
/// \param vertexOf  The vertex that each point of the plain mesh stands for. Points of one vertex stay in one place.
/// One
///                  of them, the leader, has the vertex's number.
/// \param plain     Its points follow those of the walls. It is consumed if no layer is requested.
ImprovedLayer improveLayer(const MeshingContext& context, const VertexClassification& classification,
                           const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                           const LayerOptions& options, const CurvedWallTargets& curvedWalls);

} // namespace atria
