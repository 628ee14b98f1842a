// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/Sizing.h"

#include "Octree/Sizing/ElementBudget.h"
#include "Octree/Sizing/OctantSets.h"
#include "Octree/Sizing/SizeSources.h"
#include "Octree/Sizing/UniformWalls.h"
#include "Octree/Tree/Balance.h"
#include "Support/Error.h"

namespace atria {

namespace {

void checkCounts(const SizingOptions& options)
{
  if (!(options.curvatureAngle >= 0.0) || options.curvatureAngle > 90.0 || options.cellsAcrossGap < 0 ||
      options.cellsAcrossGap > SizingOptions::maximumCellsAcrossGap || options.cellsPerLevel < 1 ||
      options.cellsPerLevel > SizingOptions::maximumCellsPerLevel)
  {
    throw Error("the curvature angle must lie in [0, 90], the cells across a gap in [0, " +
                std::to_string(SizingOptions::maximumCellsAcrossGap) + "] and the cells of a level in [1, " +
                std::to_string(SizingOptions::maximumCellsPerLevel) + "]");
  }
}

} // namespace

void balanceFor(bool hexahedra, RefinedSets& refined, const SurfaceModel& model, const GridFrame& frame,
                int cellsPerLevel, const RunContext& context)
{
  if (hexahedra)
  {
    makeUniformAtWalls(refined, model, frame, cellsPerLevel, context);
  }
  else
  {
    balance(refined, frame, context, cellsPerLevel);
  }
}

SizedOctants sizeOctants(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options,
                         const RunContext& context)
{
  checkCounts(options);
  const ModelLevels levels = modelLevels(model, frame, options);
  ElementBudget budget(model, frame, options);
  OctantSets sets(frame, requestedSizes(frame, levels, options), options, budget);
  const std::vector<GapLine> gaps = sizeForModel(sets, model, levels, options, context.part(0.0, 0.6));
  context.progress.report(0.6, "Sizing octants");
  sizeForBoxes(sets, model, options, context);
  sizeForDistances(sets, model, options, context);
  sizeForGaps(sets, gaps, context);
  context.progress.report(0.8, "Balancing");
  SizedOctants sized;
  sized.refined = sets.balanced(
      [&](RefinedSets& refined, int cellsPerLevel) {
        balanceFor(options.hexahedra, refined, model, frame, cellsPerLevel, context);
      },
      context);
  sized.warning = sets.warning();
  return sized;
}

} // namespace atria
