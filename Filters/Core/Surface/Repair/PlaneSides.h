// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Grid/Predicates.h"
#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

/// Where the corners of a triangle lie as seen from the plane of another. In double precision, and exact where that
/// does not tell. Distances are 0 at common points, and where the other triangle has no area.
class PlaneSides
{
public:
  PlaneSides(const TriangleSoup& soup, Index of, Index from, double reach);

  double distance(int corner) const { return distances[corner]; }
  int sign(int corner) const;
  /// A multiple of the distance.
  Wide exact(int corner) const;
  LatticeNormal normal() const;

  /// Where the edge between two corners on different sides passes the plane, and by how much that may be off.
  struct Passage
  {
    Vec3 at;
    double error;
  };
  Passage passage(int corner, int next) const;

  /// Whether the triangle comes nowhere within the reach of the other but at common points, as it lies on one side of
  /// its plane.
  bool apart() const { return isApart; }

private:
  const TriangleSoup& soup;
  Index triangle;
  Index plane;
  std::array<double, 3> distances{};
  bool isApart;
};

} // namespace atria
