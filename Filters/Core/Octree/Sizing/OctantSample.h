// SPDX-License-Identifier: GPL-3.0-or-later
/// Estimates from a sample how many octants the sizes request.
#pragma once

#include "Octree/Sizing/Sizing.h"

namespace atria {

/// Approximate numbers of octants before balancing, one entry per level.
struct OctantCounts
{
  std::vector<double> refined;
  /// Children of refined octants that share volume with the domain.
  std::vector<double> children;

  /// Returns the number of leaves of a level in the domain.
  double leavesAt(std::size_t level) const;
  /// Returns the number of leaves in the domain of the octree cut off at level `depth`.
  double leavesDownTo(std::size_t depth) const;
  double leaves() const { return leavesDownTo(refined.size()); }
};

/// Sizes octants as sizeOctants() does, but refines only a random sample of some thousand on levels with more than some
/// ten thousand octants. Their descendants stand for those of the others. Takes about a second for any number of
/// octants; the same input gives the same numbers. Octants that gaps and balancing add are not counted.
OctantCounts sampleOctants(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options,
                           const RunContext& context);

} // namespace atria
