// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Transitions.h"

#include "Optimize/Constraints/ModelConstraints.h"
#include "Optimize/Kernel/Optimizer.h"
#include "Support/Pieces.h"

#include <algorithm>

namespace atria {

namespace {

/// Scaled Jacobian from which on hexahedra stay as they are.
constexpr double goodEnough = 0.5;

/// Returns the elements whose vertices are of octants of several sizes, or several of which are of one octant.
std::vector<Index> transitionElements(const ClassifiedMesh& given, const MeshingContext& context)
{
  const auto& leaves = given.classification.leaves;
  return chosenNumbers(given.mesh.elementCount(), context.executor, [&](std::size_t e) {
    std::array<Index, 8> of{};
    std::ranges::transform(given.mesh.corners[e], of.begin(), [&](Index v) { return leaves[v]; });
    const int level = context.octree.level(of[0]);
    return !hasAllCorners(of) ||
           std::ranges::any_of(of, [&](Index leaf) { return context.octree.level(leaf) != level; });
  });
}

} // namespace

void improveTransitions(ClassifiedMesh& given, const MeshingContext& context)
{
  OptimizerOptions options;
  options.targets.convex = false;
  options.targets.scaledJacobian = goodEnough;
  options.rings = 1;
  MeasuredCells measured(options.targets);
  measured.outdate(transitionElements(given, context));
  const DualSource source(given.mesh);
  measured.update(source, context);
  ModelConstraints constraints(context, given.classification, given.mesh.points, given.vertexOf);
  optimize(source, given.mesh.points, measured.shortOf(options.targets, 1.0F), constraints, options, context);
}

} // namespace atria
