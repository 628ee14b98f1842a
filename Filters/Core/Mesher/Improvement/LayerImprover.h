// SPDX-License-Identifier: GPL-3.0-or-later
/// Grows the layer on walls and sees to it that every element at the boundary is valid and good.
#pragma once

#include "Layer/LayerCoverage.h"
#include "Mesher/Improvement/CurvedWalls.h"
#include "Mesher/Improvement/VertexDetachment.h"

#include <optional>

namespace atria {

struct ImprovedLayer
{
  LayerMesh layer;
  /// Vertices that are not where the model wants them, in rising order of points.
  std::vector<DetachedVertex> detached;
  /// Elements that checkMesh objects to unless they are made one with others, in order.
  std::vector<Index> failing;
  /// Of the plain mesh as it is in the end; see sizesBesideWalls.
  std::vector<double> wallSizes;
};

/// The stages of a mesh, but for crease sheets, in two parts. Between them another improver may take over what is known
/// of points.
class LayerImprover
{
public:
  /// Grows the layer. Vertices that are `away` are not where the model wants them; see VertexDetachment.
  LayerImprover(ImproverState& state, const CurvedWallTargets& curvedWalls,
                const std::vector<DetachedVertex>& away = {});

  /// Makes elements sound, with one layer on walls.
  void improveWhole();
  /// Divides the layer, and makes angles small.
  void finish();
  /// Vertices that are not where the model wants them, in rising order of points.
  const std::vector<DetachedVertex>& detached() const { return detachment_.detached(); }

private:
  ImproverState& state_;
  MeshingContext whole_;
  CurvedWallTargets wanted_;
  VertexDetachment detachment_;
  std::optional<CurvedWalls> curved_;
};

/// Elements that checkMesh objects to unless they are made one with others, in order.
std::vector<Index> findFailing(ImproverState& state);

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
