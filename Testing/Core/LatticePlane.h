// SPDX-License-Identifier: GPL-3.0-or-later
/// Points of planes on the lattice, for tests of triangulations.
#pragma once

#include "Grid/GridFrame.h"

namespace atria::testing {

/// Places points of a grid in a plane whose normal has its largest part along `axis`.
inline LatticePoint placed(std::int64_t x, std::int64_t y, int axis, std::int64_t slope)
{
  LatticePoint p;
  p[(axis + 1) % 3] = x;
  p[(axis + 2) % 3] = y;
  p[axis] = slope * (x - y) + 1000;
  return p;
}

} // namespace atria::testing
