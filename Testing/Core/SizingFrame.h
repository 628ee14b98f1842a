// SPDX-License-Identifier: GPL-3.0-or-later
/// Frames of octants of 1 m at all surfaces.
#pragma once

#include "Grid/GridFrame.h"

#include <cmath>

namespace atria::testing {

/// A root of 2^depth octants of 1 m, whose domain starts and ends half an octant inside of it.
inline GridFrame frameOf(int depth)
{
  GridFrame frame;
  frame.depth = frame.midLevel = frame.topLevel = frame.featureLevel = depth;
  frame.origin = Vec3::Constant(-0.5);
  frame.domain = {Vec3::Zero(), Vec3::Constant(std::ldexp(1.0, depth) - 1.0)};
  fitLattice(frame, {});
  return frame;
}

} // namespace atria::testing
