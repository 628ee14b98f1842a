// SPDX-License-Identifier: GPL-3.0-or-later
/// Colors the movable points of a region, so that points of one color can move at the same time.
#pragma once

#include "Optimize/Kernel/Region.h"

namespace atria {

/// The movable points of a region in the order of their colors. Points of one color do not depend on each other, except
/// those of the last color if it is serial.
struct Colors
{
  /// Color c has the points order[offsets[c]] to order[offsets[c + 1] - 1], as places in Region::movable.
  std::vector<Index> order;
  std::vector<std::size_t> offsets{0};
  bool lastIsSerial = false;

  /// True if the points of a color do not depend on each other.
  bool isParallel(std::size_t color) const { return !lastIsSerial || color + 2 < offsets.size(); }
};

/// Colors points greedily, in their order. Two points depend on each other if one writes a cell that the other reads. A
/// point writes the cells around it, and reads these and their neighbors.
Colors colorPoints(const Region& region);

} // namespace atria
