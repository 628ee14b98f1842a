// SPDX-License-Identifier: GPL-3.0-or-later
/// Distances between octants and triangles.
#pragma once

#include "Support/Types.h"
#include "Surface/Search/BoxTests.h"
#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// Distances of the points of a box from a triangle, in lattice units.
class TriangleDistance
{
public:
  TriangleDistance(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);

  /// True if some point of the box is no farther than `distance`.
  bool anyWithin(double distance) const;
  /// True if no point of the box is farther than `distance`.
  bool allWithin(double distance) const;

private:
  double fromPoint(const Vec3& p) const;
  Vec3 boxCorner(unsigned which) const;
  /// Returns the least distance of corners and pairs of edges; valid if box and triangle do not touch.
  double fromBoundary() const;

  LatticeBox box_;
  std::array<LatticePoint, 3> lattice_;
  std::array<Vec3, 3> corners_;
  double fromCenter_;
  double radius_;
};

} // namespace atria
