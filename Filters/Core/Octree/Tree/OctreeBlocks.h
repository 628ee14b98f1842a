// SPDX-License-Identifier: GPL-3.0-or-later
/// Parts of an octree, and which ranks have them.
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
  /// Roughly how many leaves each has.
  std::vector<std::size_t> leaves;

  std::size_t count() const { return leaves.size(); }
  Index blockOf(MortonKey key) const
  {
    return static_cast<Index>(std::ranges::upper_bound(begins, key) - begins.begin()) - 1;
  }
};

/// Octants with at most `most` leaves; neighbors of one parent are taken together while they have no more. They depend
/// on the sets alone.
OctreeBlocks findBlocks(const RefinedSets& refined, const GridFrame& frame, std::size_t most);

/// The first block of each rank, and after the last one their number: ranks have blocks in a row, that cost as much as
/// this allows, and one at least where there are so many.
std::vector<Index> divideBlocks(const std::vector<std::size_t>& costs, std::size_t ranks);

} // namespace atria
