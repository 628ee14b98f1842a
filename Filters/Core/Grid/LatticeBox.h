// SPDX-License-Identifier: GPL-3.0-or-later
/// Axis-aligned boxes on the integer lattice: bounds, growth, overlap and intersection.
#pragma once

#include "Grid/GridFrame.h"

#include <algorithm>
#include <concepts>

namespace atria {

/// Closed box on the lattice.
struct LatticeBox
{
  LatticePoint low;
  LatticePoint high;

  bool empty() const { return low[0] > high[0] || low[1] > high[1] || low[2] > high[2]; }
  bool contains(const LatticePoint& p) const
  {
    return p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] && p[1] <= high[1] && p[2] >= low[2] && p[2] <= high[2];
  }
  /// Grows to hold another box.
  void extend(const LatticeBox& other)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
};

/// Returns the smallest box that holds the points.
template <std::same_as<LatticePoint>... Points> LatticeBox boundsOf(const LatticePoint& first, const Points&... others)
{
  LatticeBox box{first, first};
  (box.extend({others, others}), ...);
  return box;
}

/// Returns the box grown by `by` lattice units on all sides.
inline LatticeBox grown(LatticeBox box, std::int64_t by)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] -= by;
    box.high[axis] += by;
  }
  return box;
}

inline bool overlap(const LatticeBox& a, const LatticeBox& b)
{
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    apart |= a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis];
  }
  return !apart;
}

/// Returns the intersection of two boxes that overlap.
inline LatticeBox common(const LatticeBox& a, const LatticeBox& b)
{
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = std::max(a.low[axis], b.low[axis]);
    box.high[axis] = std::min(a.high[axis], b.high[axis]);
  }
  return box;
}

} // namespace atria
