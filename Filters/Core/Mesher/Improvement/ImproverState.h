// SPDX-License-Identifier: GPL-3.0-or-later
/// What the stages of the improver work on.
#pragma once

#include "Layer/ConformingLayer.h"
#include "Mesher/Improvement/ImproverStages.h"
#include "Octree/Tree/MeshingContext.h"
#include "Optimize/Constraints/LayerConstraints.h"
#include "Optimize/Constraints/ModelConstraints.h"

namespace atria {

MeshTraits traitsOf(const DualMesh& plain, const LayerOptions& options, FlatLayers flat);

/// A mesh with the layer on its walls, where its points may go, and what its cells fall short by. Stages move points by
/// `run`; what else changes the mesh says which cells are outdated.
struct ImproverState
{
  /// See improveLayer.
  ImproverState(const MeshingContext& context, const VertexClassification& classification,
                const std::vector<Index>& vertexOf, DualMesh& plain, const LayerWalls& walls,
                const LayerOptions& options, const MeshTraits& traits);

  /// Of the cells measured those that fall short; `below` as in MeasuredCells. Cells that are outdated are measured.
  std::vector<ShortCell> findShort(const QualityTargets& targets, float below = 1.0F);
  /// Whether it is at a cut, or all of its points are settled.
  bool isOutside(Index cell) const;
  /// Runs a stage on some cells. Returns those of them and of the cells about moved points that fall short then.
  std::vector<ShortCell> run(const ImproverStage& stage, const std::vector<ShortCell>& cells);
  /// The same with constraints of one's own.
  std::vector<ShortCell> run(const OptimizerOptions& options, const std::vector<ShortCell>& cells,
                             VertexConstraints& constraints);
  /// Runs a stage on all cells it is for.
  void run(const ImproverStage& stage) { run(stage, findShort(stage.options.targets, stage.below)); }

  /// Measures all cells at the boundary, of the layer and where cells fell short before.
  void measureBy(const QualityTargets& strictest);
  /// These cells, in order, and their neighbors are to be measured again.
  void outdate(const std::vector<Index>& cells);
  /// The same for those at marked points of the plain mesh, and at what stands above these.
  void outdateAt(const std::vector<char>& points);

  /// Grows the layer.
  void grow();
  /// Grows it from the walls as they are now; copies but those of `fresh` points stay where they are.
  void growAgain(const std::vector<char>& fresh);
  /// Takes another layer of the same plain mesh instead. Elements that are as they were need not be measured.
  void replaceLayer(LayerMesh other);

  /// Its progress is that of the phase that runs.
  MeshingContext context;
  /// What the model wants, and what is allowed now.
  const VertexClassification& wanted;
  VertexClassification classification;
  const std::vector<Index>& vertexOf;
  DualMesh& plain;
  const LayerWalls& walls;
  const LayerOptions& options;
  MeshTraits traits;
  LayerGrower grower;
  LayerMesh layer;
  /// One entry per point of the plain mesh: 1 if it may leave its surface, if it has no layer, if cells there fell
  /// short after a pass, also in the second row from the walls.
  std::vector<char> mayLeave;
  std::vector<char> excluded;
  std::vector<char> suspect;
  /// By point of the plain mesh, where cells are looked for, which grows by what is outdated; empty, everywhere.
  std::vector<char> focus;
  /// The cells at the boundary, of the layer, and about points that moved.
  MeasuredCells measured;
};

/// Where points of the layer as it is now may go.
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
