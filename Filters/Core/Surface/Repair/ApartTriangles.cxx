// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/ApartTriangles.h"

#include <Eigen/Geometry>

namespace atria {

namespace {

/// Whether a triangle, but for common points, lies on one side of the plane of another, beyond the reach and what
/// rounding of doubles may hide.
bool isBeyond(const TriangleSoup& soup, Index of, Index from, double reach)
{
  constexpr double rounding = 1e-15;
  const Vec3 a = between(soup.corner(from, 0), soup.corner(from, 1));
  const Vec3 b = between(soup.corner(from, 0), soup.corner(from, 2));
  const Vec3 normal = a.cross(b);
  const double length = normal.norm();
  const double lengths = a.norm() * b.norm();
  bool above = length > 0.0;
  bool below = above;
  for (int i = 0; i < 3 && (above || below); ++i)
  {
    if (!contains(soup.triangles[from], soup.triangles[of][i]))
    {
      const Vec3 way = between(soup.corner(from, 0), soup.corner(of, i));
      const double distance = normal.dot(way);
      const double margin = reach * length + rounding * lengths * way.norm();
      above = above && distance > margin;
      below = below && distance < -margin;
    }
  }
  return above || below;
}

} // namespace

bool areApart(const TriangleSoup& soup, Index first, Index second, double reach)
{
  return isBeyond(soup, first, second, reach) || isBeyond(soup, second, first, reach);
}

} // namespace atria
