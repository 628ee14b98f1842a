// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"
#include "Surface/Model/TriangleTree.h"

namespace atria {

/// What every stage after the octree looks at: the octree, the model its leaves hold pieces of, a tree to search the
/// model, and the surroundings of the run.
struct MeshingContext : RunContext
{
  const Octree& octree;
  const SurfaceModel& model;
  const TriangleTreeOnDemand& tree;

  MeshingContext part(double first, double last) const { return {RunContext::part(first, last), octree, model, tree}; }
};

} // namespace atria
