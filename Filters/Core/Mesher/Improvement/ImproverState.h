// SPDX-License-Identifier: GPL-3.0-or-later
/// The mesh that the stages of the improver work on, and the state that they share.
#pragma once

#include "Layer/ConformingLayer.h"
#include "Mesher/Improvement/ImproverStages.h"
#include "Octree/Tree/MeshingContext.h"
#include "Optimize/Constraints/LayerConstraints.h"
#include "Optimize/Constraints/ModelConstraints.h"

namespace atria {

MeshTraits traitsOf(const DualMesh& plain, const LayerOptions& options, FlatLayers flat);

/// A mesh with the layer on its walls, the freedom of its points, and the measures of its cells. Stages move points by
/// `run`. All other code that changes the mesh must outdate the cells it changes.
struct ImproverState
{
  /// See improveLayer.
  ImproverState(const MeshingContext& context, const VertexClassification& classification,
                const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                const LayerOptions& options, const MeshTraits& traits);

  /// Returns the measured cells that fall short; `below` as in MeasuredCells. Measures outdated cells first.
  std::vector<ShortCell> findShort(const QualityTargets& targets, float below = 1.0F);
  /// True if a cell is at a cut, or all its points are settled.
  bool isOutside(Index cell) const;
  /// Runs a stage on some cells. Returns which of these, and of the cells around moved points, fall short afterwards.
  std::vector<ShortCell> run(const ImproverStage& stage, const std::vector<ShortCell>& cells);
  /// Does the same with other constraints.
  std::vector<ShortCell> run(const OptimizerOptions& options, const std::vector<ShortCell>& cells,
                             VertexConstraints& constraints);
  /// Runs a stage on all cells that take part in it.
  void run(const ImproverStage& stage) { run(stage, findShort(stage.options.targets, stage.below)); }

  /// Measures all cells of the layer, at the boundary, and where cells fell short before.
  void measureBy(const QualityTargets& strictest);
  /// Marks cells, which must be sorted, and their neighbors to be measured again.
  void outdate(const std::vector<Index>& cells);
  /// Does the same for cells at marked points of the plain mesh, and at the points above these.
  void outdateAt(const std::vector<char>& points);

  /// Grows the layer.
  void grow();
  /// Grows the layer from the present walls. Copies stay where they are, except those of `fresh` points.
  void growAgain(const std::vector<char>& fresh);
  /// Takes another layer of the same plain mesh. Elements that did not change keep their measures.
  void replaceLayer(LayerMesh other);

  /// Reports the progress of the present phase.
  MeshingContext context;
  /// Classes of vertices that the model asks for, and those that hold now.
  const VertexClassification& wanted;
  VertexClassification classification;
  const std::vector<Index>& vertexOf;
  DualMesh& plain;
  const LayerWalls& walls;
  const LayerOptions& options;
  MeshTraits traits;
  LayerGrower grower;
  LayerMesh layer;
  /// One entry per point of the plain mesh each: 1 if the point may leave its surface; if it has no layer; if cells
  /// there fell short after a pass, also in the second row from the walls.
  std::vector<char> mayLeave;
  std::vector<char> excluded;
  std::vector<char> suspect;
  /// One entry per point of the plain mesh: 1 where findShort() searches. Outdated cells are added. Empty: everywhere.
  std::vector<char> focus;
  /// Cells of the layer, at the boundary, and around points that moved.
  MeasuredCells measured;
};

/// The places where points of the present layer may go.
struct LayerFreedom
{
  explicit LayerFreedom(const ImproverState& state)
      : model(state.context, state.classification, state.layer.mesh.points, state.vertexOf),
        layer(state.layer, state.walls, state.options, state.vertexOf, model)
  {
  }

  ModelConstraints model;
  LayerConstraints layer;
};

} // namespace atria
