// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Repair/ApartTriangles.h"

#include "Support/Angles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

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

/// Whether two cones with these unit vectors as sides are on either side of a plane, 15 degrees from it each.
bool areConesApart(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b)
{
  static const double least = cosOfDegrees(90.0 - 15.0);
  const Vec3 normal = (a[0] + a[1] - b[0] - b[1]).normalized();
  return std::min(normal.dot(a[0]), normal.dot(a[1])) > least && std::max(normal.dot(b[0]), normal.dot(b[1])) < -least;
}

/// The corners of a triangle, those first that another has, too; and how many these are.
struct SortedCorners
{
  std::array<int, 3> order{};
  int common = 0;

  SortedCorners(const std::array<Index, 3>& corners, const std::array<Index, 3>& other)
  {
    int end = 3;
    for (int i = 0; i < 3; ++i)
    {
      order[contains(other, corners[i]) ? common++ : --end] = i;
    }
  }
};

/// Whether two triangles have points in common, as most that are near each other do, and part there by more than 30
/// degrees: then they touch nowhere else. What of one is within reach of the other would be within twice that of the
/// common point or edge. No other point is so near to a point, as they would have become one; a triangle with a point
/// so near to the common edge is looked at.
bool partInCommonPoints(const TriangleSoup& soup, Index first, Index second, double reach)
{
  const SortedCorners a(soup.triangles[first], soup.triangles[second]);
  const SortedCorners b(soup.triangles[second], soup.triangles[first]);
  if (a.common != b.common || a.common == 0 || a.common == 3)
  {
    return false;
  }
  const LatticePoint& corner = soup.corner(first, a.order[0]);
  const auto way = [&](Index t, int i) { return between(corner, soup.corner(t, i)); };
  if (a.common == 1)
  {
    return areConesApart({way(first, a.order[1]).normalized(), way(first, a.order[2]).normalized()},
                         {way(second, b.order[1]).normalized(), way(second, b.order[2]).normalized()});
  }
  const Vec3 along = way(first, a.order[1]).normalized();
  const auto across = [&](const Vec3& v) { return Vec3(v - along.dot(v) * along); };
  const Vec3 u = across(way(first, a.order[2]));
  const Vec3 v = across(way(second, b.order[2]));
  return std::min(u.norm(), v.norm()) > 2.0 * reach &&
         areConesApart({u.normalized(), u.normalized()}, {v.normalized(), v.normalized()});
}

} // namespace

bool areApart(const TriangleSoup& soup, Index first, Index second, double reach)
{
  return isBeyond(soup, first, second, reach) || isBeyond(soup, second, first, reach) ||
         partInCommonPoints(soup, first, second, reach);
}

} // namespace atria
