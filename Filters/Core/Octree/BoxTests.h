// SPDX-License-Identifier: GPL-3.0-or-later
/// Which pieces of the model touch an octant. Conservative: what touches the box is never missed; what is farther away
/// than rounding (some lattice units) is never found.
#pragma once

#include "Domain/GridFrame.h"

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
};

/// Separating axes (Akenine-Möller 2001).
bool touches(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);
bool touches(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b);

/// Parameters [t0, t1] of the part of segment a-b in the box; t0 > t1 where there is none.
struct SegmentRange
{
  double begin = 0.0;
  double end = 1.0;
  bool empty() const { return begin > end; }
};
SegmentRange clipSegment(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b);

} // namespace atria
