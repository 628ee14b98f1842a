// SPDX-License-Identifier: GPL-3.0-or-later
/// Which pieces of the model touch an octant. Conservative: what touches the box is never missed; what is farther away
/// than rounding (some lattice units) is never found.
#pragma once

#include "Grid/GridFrame.h"

#include <array>

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

/// By so much on all sides.
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

/// A triangle to test against several boxes: what does not depend on the box is found once, and not before it is
/// needed. Separating axes (Akenine-Möller 2001).
class TriangleBoxTest
{
public:
  TriangleBoxTest(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);
  bool touches(const LatticeBox& box);

private:
  void findAxes();
  bool isSeparate(const LatticeBox& box);

  std::array<LatticePoint, 3> corners_;
  LatticePoint low_;
  LatticePoint high_;
  /// The normal and those normal to an edge and an axis of the grid; 0 until they are found.
  std::size_t count_ = 0;
  std::array<Vec3, 10> axes_;
  /// How far a box of this half size reaches along each.
  Vec3 half_ = Vec3::Constant(-1.0);
  std::array<double, 10> reaches_;
};

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
