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
  /// Balanced sets.
  RefinedSets refined;
  /// Text that names the sizes taken to keep to `maxElements`; empty if all requested sizes were kept.
  std::string warning;
};

/// Balances sets for a mesh of hexahedra only (SizingOptions::hexahedra), or of all elements.
void balanceFor(bool hexahedra, RefinedSets& refined, const SurfaceModel& model, const GridFrame& frame,
                int cellsPerLevel, const RunContext& context);

/// Sizes octants and balances them. Below the top level, an octant is refined for its pieces of the model, for boxes
/// and distances, for curvature and gaps (see docs/algorithm.md). `frame` must have been made with
/// finestSizeOf(options). Throws Error for sizes that are not positive, patterns that match no surface (naming all
/// surfaces), boxes outside of the domain, or if not even the start level keeps to `maxElements`. Throws
/// TooManyElements (see ElementBudget.h) if the elements do not fit `memoryLimit`.
SizedOctants sizeOctants(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options,
                         const RunContext& context);

} // namespace atria
