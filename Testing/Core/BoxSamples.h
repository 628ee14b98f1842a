// SPDX-License-Identifier: GPL-3.0-or-later
/// Boxes on the lattice that tests of searches move, number and compare.
#pragma once

#include "Surface/Search/BoxPairs.h"

#include <vector>

namespace atria::testing {

inline bool areTouching(const LatticeBox& a, const LatticeBox& b)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis])
    {
      return false;
    }
  }
  return true;
}

inline bool isSame(const LatticeBox& a, const LatticeBox& b) { return a.low == b.low && a.high == b.high; }

inline LatticeBox moved(LatticeBox box, std::int64_t by)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] += by;
    box.high[axis] += by;
  }
  return box;
}

inline std::vector<NumberedBox> numbered(const std::vector<LatticeBox>& boxes)
{
  std::vector<NumberedBox> out;
  for (const LatticeBox& box : boxes)
  {
    out.push_back({box, static_cast<Index>(out.size())});
  }
  return out;
}

} // namespace atria::testing
