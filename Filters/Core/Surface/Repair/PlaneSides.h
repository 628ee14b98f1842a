// SPDX-License-Identifier: GPL-3.0-or-later
/// Tells on which side of a triangle's plane the corners of another one lie.
#pragma once

#include "Grid/Predicates.h"
#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// Distances of a triangle's corners from the plane of another. They are in double precision, and exact where that does
/// not decide the side. Distances are 0 at common points, and if the other triangle has no area.
class PlaneSides
{
public:
  PlaneSides(const TriangleSoup& soup, Index of, Index from, double reach);

  double distance(int corner) const { return distances[corner]; }
  int sign(int corner) const;
  /// Returns an exact multiple of the distance.
  Wide exact(int corner) const;
  LatticeNormal normal() const;

  /// The point where the edge between two corners on different sides passes the plane, and its largest error.
  struct Passage
  {
    Vec3 at;
    double error;
  };
  Passage passage(int corner, int next) const;

  /// True if the triangle lies on one side of the other's plane and comes within its reach only at common points.
  bool apart() const { return isApart; }

private:
  const TriangleSoup& soup;
  Index triangle;
  Index plane;
  std::array<double, 3> distances{};
  bool isApart;
};

} // namespace atria
