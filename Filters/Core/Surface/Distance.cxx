// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace atria {

Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 along = b - a;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp(along.dot(p - a) / squared, 0.0, 1.0) : 0.0;
  return a + t * along;
}

Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 normal = (b - a).cross(c - a);
  const double squared = normal.squaredNorm();
  if (squared > 0.0)
  {
    const Vec3 q = p - normal * (normal.dot(p - a) / squared);
    const bool inside = normal.dot((b - a).cross(q - a)) >= 0.0 && normal.dot((c - b).cross(q - b)) >= 0.0 &&
                        normal.dot((a - c).cross(q - c)) >= 0.0;
    if (inside)
    {
      return q;
    }
  }
  const std::array<Vec3, 3> candidates{nearestOnSegment(p, a, b), nearestOnSegment(p, b, c), nearestOnSegment(p, c, a)};
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](const Vec3& l, const Vec3& r) { return (l - p).squaredNorm() < (r - p).squaredNorm(); });
}

} // namespace atria
