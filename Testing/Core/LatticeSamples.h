// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers and points on the lattice, for tests of places and boxes.
#pragma once

#include "Random.h"

#include <vector>

namespace atria::testing {

/// All points of a small cube of the lattice.
inline std::vector<LatticePoint> pointsOf(std::int64_t low, std::int64_t high)
{
  std::vector<LatticePoint> points;
  for (std::int64_t x = low; x <= high; ++x)
  {
    for (std::int64_t y = low; y <= high; ++y)
    {
      for (std::int64_t z = low; z <= high; ++z)
      {
        points.push_back({x, y, z});
      }
    }
  }
  return points;
}

} // namespace atria::testing
