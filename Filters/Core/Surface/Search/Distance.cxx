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
  const bool hasArea = squared > 0.0;
  const Vec3 q = hasArea ? Vec3(p - normal * (normal.dot(p - a) / squared)) : p;
  // The nearest place is on an edge beyond which it lies, or on any edge of a triangle without area.
  NearestPlace best{p};
  const auto offer = [&](const Vec3& from, const Vec3& to) {
    if (!hasArea || !(normal.dot((to - from).cross(q - from)) >= 0.0))
    {
      best.offer(nearestOnSegment(p, from, to));
    }
  };
  offer(a, b);
  offer(b, c);
  offer(c, a);
  return best.found() ? best.at : q;
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
  // Parallel segments: any start will do, as each end is put on the other segment afterwards.
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
