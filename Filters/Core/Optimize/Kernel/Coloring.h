// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Optimize/Kernel/Region.h"

namespace atria {

/// The movable points of a region in an order of classes. Points of one class do not depend on each other, except in
/// the last, if it is not parallel.
struct Colors
{
  std::vector<Index> order;
  std::vector<std::size_t> offsets{0};
  bool lastIsSerial = false;

  bool isParallel(std::size_t color) const { return !lastIsSerial || color + 2 < offsets.size(); }
};

/// Greedy, in the order of the points. What a point writes are the cells about it; what it reads, these and their
/// neighbors.
Colors colorPoints(const Region& region);

} // namespace atria
