// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Search/Distance.h"

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

NearestPair nearestOfSegments(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b)
{
  const Vec3 u = q - p;
  const Vec3 v = b - a;
  const Vec3 w = p - a;
  const double uu = u.squaredNorm();
  const double uv = u.dot(v);
  const double vv = v.squaredNorm();
  const double determinant = uu * vv - uv * uv;
  // Parallel segments: any start does, as each end is put on the other segment afterwards.
  const double s =
      determinant > 1e-12 * uu * vv ? std::clamp((uv * v.dot(w) - vv * u.dot(w)) / determinant, 0.0, 1.0) : 0.0;
  NearestPair pair;
  pair.second = nearestOnSegment(p + s * u, a, b);
  pair.first = nearestOnSegment(pair.second, p, q);
  pair.second = nearestOnSegment(pair.first, a, b);
  return pair;
}

NearestPair nearestOfSegmentAndTriangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const std::array<NearestPair, 5> candidates{
      NearestPair{p, nearestOnTriangle(p, a, b, c)}, NearestPair{q, nearestOnTriangle(q, a, b, c)},
      nearestOfSegments(p, q, a, b), nearestOfSegments(p, q, b, c), nearestOfSegments(p, q, c, a)};
  return *std::min_element(candidates.begin(), candidates.end(),
                           [](const NearestPair& l, const NearestPair& r) { return l.distance() < r.distance(); });
}

} // namespace atria
