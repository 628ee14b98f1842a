// SPDX-License-Identifier: GPL-3.0-or-later
/// Which pieces of the model touch an octant. Conservative: what touches the box is never missed; what is farther away
/// than rounding (some lattice units) is never found.
#pragma once

#include "Grid/LatticeBox.h"

#include <array>

namespace atria {

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
  LatticeBox bounds_;
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
