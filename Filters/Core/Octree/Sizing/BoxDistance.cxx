// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/Sizing/BoxDistance.h"

#include "Surface/Search/Distance.h"

#include <algorithm>
#include <cmath>

namespace atria {

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
        least = std::min(
            least, nearestOfSegments(corner, boxCorner(k | 1u << axis), corners_[i], corners_[(i + 1) % 3]).distance());
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

} // namespace atria
