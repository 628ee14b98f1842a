// SPDX-License-Identifier: GPL-3.0-or-later
/// Distances between octants and triangles.
#pragma once

#include "Support/Types.h"
#include "Surface/Search/BoxTests.h"
#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// How far the points of a box are from a triangle, in lattice units.
class TriangleDistance
{
public:
  TriangleDistance(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);

  /// Some point of the box is no farther than `distance`.
  bool anyWithin(double distance) const;
  /// All points of the box are no farther than `distance`.
  bool allWithin(double distance) const;

private:
  double fromPoint(const Vec3& p) const;
  Vec3 boxCorner(unsigned which) const;
  /// The nearest of box corners, triangle corners and pairs of edges; valid where box and triangle do not touch.
  double fromBoundary() const;

  LatticeBox box_;
  std::array<LatticePoint, 3> lattice_;
  std::array<Vec3, 3> corners_;
  double fromCenter_;
  double radius_;
};

} // namespace atria
