// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests which pieces of the model touch an octant. The tests are conservative: pieces that touch the box are never
/// missed, and pieces farther away than rounding (some lattice units) are never found.
#pragma once

#include "Grid/LatticeBox.h"

#include <array>

namespace atria {

/// A triangle to test against several boxes by separating axes (Akenine-Möller 2001). Data that does not depend on the
/// box is found once, and not before it is needed.
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
  /// The normal, and directions normal to an edge and an axis of the grid; 0 until they are found.
  std::size_t count_ = 0;
  std::array<Vec3, 10> axes_;
  /// Half size of the last box, and its reach along each axis.
  Vec3 half_ = Vec3::Constant(-1.0);
  std::array<double, 10> reaches_;
};

bool touches(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);
bool touches(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b);

/// Parameters [t0, t1] of the part of segment a-b in the box; t0 > t1 if there is none.
struct SegmentRange
{
  double begin = 0.0;
  double end = 1.0;
  bool empty() const { return begin > end; }
};
SegmentRange clipSegment(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b);

} // namespace atria
