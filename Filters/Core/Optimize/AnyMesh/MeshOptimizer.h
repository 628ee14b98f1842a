// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes any mesh valid and good by moving its points.
#pragma once

#include "Optimize/Kernel/Optimizer.h"

namespace atria {

struct MeshOptimizerOptions
{
  MeshOptimizerOptions();

  /// Edges of the boundary are kept if the normals beside them differ by more than this, and points if kept edges turn
  /// there by more; degrees.
  double featureAngle = 30.0;
  /// True to keep points on the boundary where they are.
  bool fixedBoundary = false;
  /// Points that stay where they are, such as those of zones.
  std::vector<Index> keptPoints;
  /// Defaults other than those of OptimizerOptions: among others, no metric may get worse than its worst value, and
  /// cells with a scaled Jacobian are judged by it, too.
  OptimizerOptions optimizer;
};

struct MeshOptimizerReport
{
  std::size_t movedPoints = 0;
  /// Numbers of cells that fall short of a target, before and after.
  std::size_t shortBefore = 0;
  std::size_t shortAfter = 0;
  /// One entry per cell, after the run: the smallest relative measure of the cell and its faces; 0 at the limit of what
  /// is valid or usable, 1 if all targets are reached.
  std::vector<float> shares;
};

/// Moves points of a mesh that was made of `cells`. If more cells fall short afterwards than before, the mesh stays as
/// it was. `patches` has one entry per boundary face: its patch; empty if all are in one. Edges between patches are
/// kept.
///
/// Returns what was achieved. The result has the same bits for any number of threads. Throws Aborted when asked to.
MeshOptimizerReport optimizeMesh(FaceMesh& mesh, const CellArrays& cells, std::span<const Index> patches,
                                 const MeshOptimizerOptions& options, const RunContext& context);

} // namespace atria
