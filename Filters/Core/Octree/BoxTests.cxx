// SPDX-License-Identifier: GPL-3.0-or-later
#include "Octree/BoxTests.h"

#include "Support/Types.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// A box about the origin, and points relative to its centre.
struct CenteredBox
{
  explicit CenteredBox(const LatticeBox& box)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      center[axis] = 0.5 * static_cast<double>(box.low[axis] + box.high[axis]);
      half[axis] = 0.5 * static_cast<double>(box.high[axis] - box.low[axis]);
    }
  }

  Vec3 relative(const LatticePoint& p) const
  {
    return Vec3(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])) - center;
  }

  Vec3 center;
  Vec3 half;
};

constexpr double roundingUnits = 4.0;

bool separatedAlong(const Vec3& axis, const Vec3& half, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const double radius = half.dot(axis.cwiseAbs()) + roundingUnits * axis.cwiseAbs().maxCoeff();
  const double p = axis.dot(a);
  const double q = axis.dot(b);
  const double r = axis.dot(c);
  return std::min({p, q, r}) > radius || std::max({p, q, r}) < -radius;
}

bool boundsApart(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (std::min({a[axis], b[axis], c[axis]}) > box.high[axis] || std::max({a[axis], b[axis], c[axis]}) < box.low[axis])
    {
      return true;
    }
  }
  return false;
}

} // namespace

bool touches(const LatticeBox& box, const LatticePoint& pa, const LatticePoint& pb, const LatticePoint& pc)
{
  if (boundsApart(box, pa, pb, pc))
  {
    return false;
  }
  if (box.contains(pa) || box.contains(pb) || box.contains(pc))
  {
    return true;
  }
  const CenteredBox centered(box);
  const Vec3 a = centered.relative(pa);
  const Vec3 b = centered.relative(pb);
  const Vec3 c = centered.relative(pc);
  const Vec3 edges[3] = {b - a, c - b, a - c};
  if (separatedAlong(edges[0].cross(edges[1]).normalized(), centered.half, a, b, c))
  {
    return false;
  }
  for (const Vec3& edge : edges)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3 direction = edge.cross(Vec3::Unit(axis));
      const double length = direction.norm();
      if (length > 0.0 && separatedAlong(direction / length, centered.half, a, b, c))
      {
        return false;
      }
    }
  }
  return true;
}

bool touches(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b)
{
  constexpr auto margin = static_cast<std::int64_t>(roundingUnits);
  const LatticeBox wider{{box.low[0] - margin, box.low[1] - margin, box.low[2] - margin},
                         {box.high[0] + margin, box.high[1] + margin, box.high[2] + margin}};
  return !clipSegment(wider, a, b).empty();
}

SegmentRange clipSegment(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b)
{
  constexpr SegmentRange none{1.0, 0.0};
  SegmentRange range;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto low = static_cast<double>(box.low[axis] - a[axis]);
    const auto high = static_cast<double>(box.high[axis] - a[axis]);
    const auto along = static_cast<double>(b[axis] - a[axis]);
    if (along == 0.0)
    {
      if (low > 0.0 || high < 0.0)
      {
        return none;
      }
      continue;
    }
    range.begin = std::max(range.begin, std::min(low / along, high / along));
    range.end = std::min(range.end, std::max(low / along, high / along));
  }
  return range;
}

} // namespace atria
