// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes any mesh valid and good by moving its points.
#pragma once

#include "Optimize/Kernel/Optimizer.h"

namespace atria {

struct MeshOptimizerOptions
{
  MeshOptimizerOptions();

  /// Edges of the boundary where normals differ by more are kept, and points where these turn by more; degrees.
  double featureAngle = 30.0;
  /// Whether points on the boundary stay where they are.
  bool fixedBoundary = false;
  /// Points that stay where they are, such as those of zones.
  std::vector<Index> keptPoints;
  /// Here no metric's worst gets worse, and cells that have a scaled Jacobian are judged by it, too.
  OptimizerOptions optimizer;
};

struct MeshOptimizerReport
{
  std::size_t movedPoints = 0;
  /// Cells that fell short of a target, and that do now.
  std::size_t shortBefore = 0;
  std::size_t shortAfter = 0;
  /// By cell the least of its measures, those of its faces included, now: 0 at the limit of what is valid or usable,
  /// 1 where all targets are reached.
  std::vector<float> shares;
};

/// Moves points of a mesh that was made of `cells`. `patches` gives the patch of each boundary face, or is empty; edges
/// between patches are kept. Throws Aborted when asked to. The same bits for any number of threads.
MeshOptimizerReport optimizeMesh(FaceMesh& mesh, const CellArrays& cells, std::span<const Index> patches,
                                 const MeshOptimizerOptions& options, const RunContext& context);

} // namespace atria
