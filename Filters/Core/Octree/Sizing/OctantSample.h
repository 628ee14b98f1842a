// SPDX-License-Identifier: GPL-3.0-or-later
/// How many octants sizes ask for, from a part of them.
#pragma once

#include "Octree/Sizing/Sizing.h"

namespace atria {

/// About how many octants there are, before they are balanced. Indices are levels.
struct OctantCounts
{
  std::vector<double> refined;
  /// Children of these that share volume with the domain.
  std::vector<double> children;

  /// Leaves in the domain.
  double leavesAt(std::size_t level) const;
  /// Leaves in the domain of the octree without what is finer than `depth`.
  double leavesDownTo(std::size_t depth) const;
  double leaves() const { return leavesDownTo(refined.size()); }
};

/// Sizes octants as sizeOctants() does, but where a level has more than some ten thousand, goes on from some thousand
/// of them, taken at random, and counts their descendants for those of the others too. That is a second of work however
/// many octants there are; the same input gives the same numbers. What gaps and balancing add is not counted.
OctantCounts sampleOctants(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options,
                           const RunContext& context);

} // namespace atria
