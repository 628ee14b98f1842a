// SPDX-License-Identifier: GPL-3.0-or-later
/// A refinement that needs no model: octants that a sphere passes through, down to a depth. Not balanced.
#pragma once

#include "Grid/GridFrame.h"
#include "Grid/Morton.h"
#include "Octree/Tree/Octree.h"

#include <array>
#include <cmath>

namespace atria::measuring {

/// The sphere about the middle of the root cube, of 0.35 of its size, in an octant of `level`.
inline bool meetsSphere(const GridCell& cell, int level)
{
  const double size = 1.0 / static_cast<double>(1 << level);
  double nearest = 0.0;
  double farthest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = cell[axis] * size - 0.5;
    const double high = low + size;
    const double inside = low > 0.0 ? low : high < 0.0 ? -high : 0.0;
    const double outside = std::fmax(std::fabs(low), std::fabs(high));
    nearest += inside * inside;
    farthest += outside * outside;
  }
  constexpr double square = 0.35 * 0.35;
  return nearest <= square && square <= farthest;
}

/// The refined octants, by level.
inline RefinedSets sphereOctants(int depth)
{
  RefinedSets sets{{0}};
  for (int level = 1; level < depth; ++level)
  {
    std::vector<MortonKey> keys;
    for (const MortonKey parent : sets.back())
    {
      for (MortonKey child = 8 * parent; child < 8 * parent + 8; ++child)
      {
        if (meetsSphere(gridCell(child), level))
        {
          keys.push_back(child);
        }
      }
    }
    sets.push_back(std::move(keys));
  }
  return sets;
}

/// A frame all of whose root cube is domain.
inline GridFrame sphereFrame(int depth)
{
  GridOptions options;
  options.domain = {Vec3::Zero(), Vec3::Constant(static_cast<double>((1 << depth) - 1))};
  options.sizeMin = options.sizeMid = options.sizeMax = 1.0;
  options.startLevel = 0;
  return makeGridFrame(options, options.domain);
}

} // namespace atria::measuring
