// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes octants by rules.
#pragma once

#include "Octree/Sizing/SizingOptions.h"
#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

#include <string>

namespace atria {

/// Result of sizeOctants.
struct SizedOctants
{
  /// Balanced.
  RefinedSets refined;
  /// Names the sizes taken to keep to `maxElements`; empty if all requested sizes were kept.
  std::string warning;
};

/// Sizes octants and balances them. Below the top level, an octant is refined for what it holds of the model, for boxes
/// and distances, for curvature and gaps (see docs/algorithm.md). `frame` must have been made with
/// finestSizeOf(options). Throws Error for sizes that are not positive, patterns without a surface (naming those there
/// are), boxes outside of the domain, or where not even the start level keeps to `maxElements`; TooManyElements (see
/// ElementBudget.h) where the elements do not fit `memoryLimit`.
SizedOctants sizeOctants(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options,
                         const RunContext& context);

} // namespace atria
