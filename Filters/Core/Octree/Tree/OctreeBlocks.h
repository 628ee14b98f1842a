// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides an octree into blocks, and blocks among ranks.
#pragma once

#include "Octree/Tree/Octree.h"

namespace atria {

/// Leaves of an octree in Morton order, by keys of the finest grid: from `begin` up to `end`.
struct MortonRange
{
  MortonKey begin;
  MortonKey end;
};

/// Ranges along the Morton order that end at octants: block b has the leaves from begins[b] to begins[b + 1], by keys
/// of the finest grid. The last is the end of all.
struct OctreeBlocks
{
  std::vector<MortonKey> begins;
  /// Approximate number of leaves per block.
  std::vector<std::size_t> leaves;

  std::size_t count() const { return leaves.size(); }
  Index blockOf(MortonKey key) const
  {
    return static_cast<Index>(std::ranges::upper_bound(begins, key) - begins.begin()) - 1;
  }
};

/// Returns octants with at most `most` leaves as blocks. Neighboring children of one parent are merged while they have
/// no more. The blocks depend on the sets alone.
OctreeBlocks findBlocks(const RefinedSets& refined, const GridFrame& frame, std::size_t most);

/// Returns the first block of each rank, followed by the number of blocks. Ranks get consecutive blocks of costs as
/// equal as this allows, and at least one if there are that many.
std::vector<Index> divideBlocks(const std::vector<std::size_t>& costs, std::size_t ranks);

} // namespace atria
