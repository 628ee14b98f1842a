// SPDX-License-Identifier: GPL-3.0-or-later
/// Bundles the octree, the model and the run for the stages after the octree.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"
#include "Surface/Model/TriangleTree.h"

namespace atria {

/// Common input of the stages after the octree: the octree, the model whose pieces its leaves hold, a tree to search
/// the model, and the context of the run.
struct MeshingContext : RunContext
{
  const Octree& octree;
  const SurfaceModel& model;
  const TriangleTreeOnDemand& tree;

  MeshingContext part(double first, double last) const { return {RunContext::part(first, last), octree, model, tree}; }
};

} // namespace atria
