// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers and points on the lattice, for tests of places and boxes.
#pragma once

#include "Grid/GridFrame.h"

#include <random>
#include <vector>

namespace atria::testing {

/// Draws numbers and points.
class Random
{
public:
  explicit Random(unsigned seed) : bits(seed) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits); }
  std::int64_t in(std::int64_t low, std::int64_t high)
  {
    return std::uniform_int_distribution<std::int64_t>(low, high)(bits);
  }
  Vec3 vector(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  LatticePoint point(std::int64_t low, std::int64_t high) { return {in(low, high), in(low, high), in(low, high)}; }

private:
  std::mt19937 bits;
};

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
