// SPDX-License-Identifier: GPL-3.0-or-later
/// Estimates the size of a mesh from the refined octants alone.
#pragma once

#include "Octree/Sizing/Sizing.h"

#include <span>

namespace atria {

/// Returns the number of grid points inside the domain that refining the octants `refined` of `level` adds: those of
/// level + 1 that are none of `level`. Every grid point is one element if all zones are meshed. O(n log n).
std::size_t countNewPoints(const std::vector<MortonKey>& refined, int level, const GridFrame& frame,
                           const RunContext& context);

/// Returns the number of children of refined octants of `level` that share volume with the domain.
std::size_t childrenInDomain(std::span<const MortonKey> refined, int level, const GridFrame& frame,
                             const RunContext& context);

/// Returns the number of grid points, inside the domain, of the octree that balanced sets make; of the octree whose
/// octants are split (SplitOctants) if the mesh is to have hexahedra only.
std::size_t countElements(const RefinedSets& refined, bool hexahedra, const GridFrame& frame,
                          const RunContext& context);

struct MeshEstimate
{
  /// Number of leaves that share volume with the domain, one entry per level.
  std::vector<std::size_t> octants;
  /// Exact if all zones are meshed; zones that are left out have no elements.
  std::size_t elements = 0;
  /// Approximate memory that meshing takes at its peak.
  std::size_t bytes = 0;
  /// True if the elements do not fit the memory. All numbers are then lower bounds, from a part of the octants, which
  /// are not balanced.
  bool isTooLarge = false;
  /// Same as SizedOctants::warning; or the reason why the elements are refused.
  std::string warning;
};

/// Sizes octants and counts what they make, without building octree or mesh. Takes a few per cent of the memory of
/// meshing. Returns approximate numbers (see isTooLarge) if sizeOctants() would throw TooManyElements.
MeshEstimate estimateElements(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& options,
                              const RunContext& context);

} // namespace atria
