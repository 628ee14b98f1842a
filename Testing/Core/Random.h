// SPDX-License-Identifier: GPL-3.0-or-later
/// Random numbers and points, the same for the same seed.
#pragma once

#include "Grid/GridFrame.h"

#include <random>

namespace atria::testing {

class Random
{
public:
  explicit Random(unsigned seed) : bits(seed) {}

  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(bits); }
  std::int64_t whole(std::int64_t low, std::int64_t high)
  {
    return std::uniform_int_distribution<std::int64_t>(low, high)(bits);
  }
  std::size_t below(std::size_t end) { return bits() % end; }
  Vec3 vector(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  LatticePoint point(std::int64_t low, std::int64_t high)
  {
    return {whole(low, high), whole(low, high), whole(low, high)};
  }

private:
  std::mt19937 bits;
};

} // namespace atria::testing
