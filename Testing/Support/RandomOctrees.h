// SPDX-License-Identifier: GPL-3.0-or-later
/// Octrees that are refined at random.
#pragma once

#include "Octree/Tree/Octree.h"

#include <gtest/gtest.h>

#include <random>

namespace atria::testing {

/// Returns the frame of a domain of this size, with octants of size 1 down to the finest.
inline GridFrame frameOfDepth(int depth, const Vec3& size)
{
  GridOptions grid;
  grid.domain = {Vec3::Zero(), size};
  grid.sizeMin = 1.0;
  grid.sizeMid = grid.sizeMax = 1.0;
  grid.startLevel = 1;
  GridFrame frame = makeGridFrame(grid, {});
  EXPECT_EQ(frame.depth, depth);
  return frame;
}

/// Refines octants of each level at random. The sets are not balanced.
inline RefinedSets randomSets(const GridFrame& frame, std::mt19937& random)
{
  RefinedSets sets{{0}};
  for (int level = 1; level < frame.depth; ++level)
  {
    std::vector<MortonKey> next;
    for (const MortonKey key : sets.back())
    {
      for (MortonKey k = 0; k < 8; ++k)
      {
        // Down to the coarsest octants the domain allows everything is refined.
        if (level < 2 || random() % 4 == 0)
        {
          next.push_back(key << 3 | k);
        }
      }
    }
    if (next.empty())
    {
      break;
    }
    sets.push_back(std::move(next));
  }
  return sets;
}

} // namespace atria::testing
