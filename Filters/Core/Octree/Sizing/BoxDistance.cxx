// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/BoxDistance.h"

#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Distance of two segments (Ericson 2005, 5.1.9).
double segmentDistance(const Vec3& p, const Vec3& alongP, const Vec3& q, const Vec3& alongQ)
{
  const Vec3 apart = p - q;
  const double a = alongP.squaredNorm();
  const double e = alongQ.squaredNorm();
  const double b = alongP.dot(alongQ);
  const double c = alongP.dot(apart);
  const double f = alongQ.dot(apart);
  const double denominator = a * e - b * b;
  double s = denominator > 1e-12 * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  const double t = e > 0.0 ? std::clamp((b * s + f) / e, 0.0, 1.0) : 0.0;
  s = a > 0.0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0.0;
  return (apart + s * alongP - t * alongQ).norm();
}

} // namespace

TriangleDistance::TriangleDistance(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b,
                                   const LatticePoint& c)
    : box_(box), lattice_{a, b, c}, corners_{toVector(a), toVector(b), toVector(c)}
{
  const Vec3 low = toVector(box.low);
  const Vec3 high = toVector(box.high);
  fromCenter_ = fromPoint(0.5 * (low + high));
  radius_ = 0.5 * (high - low).norm();
}

double TriangleDistance::fromPoint(const Vec3& p) const
{
  return (nearestOnTriangle(p, corners_[0], corners_[1], corners_[2]) - p).norm();
}

Vec3 TriangleDistance::boxCorner(unsigned which) const
{
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis)
  {
    p[axis] = static_cast<double>(which >> axis & 1 ? box_.high[axis] : box_.low[axis]);
  }
  return p;
}

bool TriangleDistance::allWithin(double distance) const
{
  if (fromCenter_ > distance)
  {
    return false;
  }
  // The distance from a convex set is a convex function, so the farthest point of the box is a corner.
  bool within = true;
  for (unsigned k = 0; k < 8 && within && fromCenter_ + radius_ > distance; ++k)
  {
    within = fromPoint(boxCorner(k)) <= distance;
  }
  return within;
}

bool TriangleDistance::anyWithin(double distance) const
{
  if (fromCenter_ <= distance)
  {
    return true;
  }
  return fromCenter_ - radius_ <= distance &&
         (touches(box_, lattice_[0], lattice_[1], lattice_[2]) || fromBoundary() <= distance);
}

double TriangleDistance::fromBoundary() const
{
  double least = std::numeric_limits<double>::infinity();
  for (unsigned k = 0; k < 8; ++k)
  {
    const Vec3 corner = boxCorner(k);
    least = std::min(least, fromPoint(corner));
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      for (int i = 0; i < 3 && (k >> axis & 1) == 0; ++i)
      {
        const Vec3 along = corners_[(i + 1) % 3] - corners_[i];
        least = std::min(least, segmentDistance(corner, boxCorner(k | 1u << axis) - corner, corners_[i], along));
      }
    }
  }
  const Vec3 low = boxCorner(0);
  const Vec3 high = boxCorner(7);
  for (const Vec3& corner : corners_)
  {
    least = std::min(least, (corner.cwiseMax(low).cwiseMin(high) - corner).norm());
  }
  return least;
}

bool segmentWithin(const LatticeBox& box, const Vec3& margin, const Vec3& from, const Vec3& to)
{
  double begin = 0.0;
  double end = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = static_cast<double>(box.low[axis]) - margin[axis] - from[axis];
    const double high = static_cast<double>(box.high[axis]) + margin[axis] - from[axis];
    const double along = to[axis] - from[axis];
    if (along == 0.0)
    {
      if (low > 0.0 || high < 0.0)
      {
        return false;
      }
      continue;
    }
    begin = std::max(begin, std::min(low / along, high / along));
    end = std::min(end, std::max(low / along, high / along));
  }
  return begin <= end;
}

} // namespace atria
