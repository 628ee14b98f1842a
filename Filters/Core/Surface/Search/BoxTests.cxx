// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Search/BoxTests.h"

#include "Support/Types.h"
#include "Surface/Search/Slabs.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// A box around the origin, and points relative to its center.
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

} // namespace

TriangleBoxTest::TriangleBoxTest(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
    : corners_{a, b, c}, bounds_(boundsOf(a, b, c))
{
}

bool TriangleBoxTest::touches(const LatticeBox& box)
{
  return overlap(bounds_, box) &&
         (std::ranges::any_of(corners_, [&](const LatticePoint& p) { return box.contains(p); }) || !isSeparate(box));
}

/// Finds the axes. Lattice coordinates have some 40 bits, so that edges are exact.
void TriangleBoxTest::findAxes()
{
  const auto edge = [&](int from, int to) {
    return Vec3(static_cast<double>(corners_[to][0] - corners_[from][0]),
                static_cast<double>(corners_[to][1] - corners_[from][1]),
                static_cast<double>(corners_[to][2] - corners_[from][2]));
  };
  const std::array<Vec3, 3> edges{edge(0, 1), edge(1, 2), edge(2, 0)};
  axes_[count_++] = edges[0].cross(edges[1]).normalized();
  for (const Vec3& along : edges)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3 direction = along.cross(Vec3::Unit(axis));
      const double length = direction.norm();
      if (length > 0.0)
      {
        axes_[count_++] = direction / length;
      }
    }
  }
}

bool TriangleBoxTest::isSeparate(const LatticeBox& box)
{
  if (count_ == 0)
  {
    findAxes();
  }
  const CenteredBox centered(box);
  if (half_ != centered.half)
  {
    half_ = centered.half;
    for (std::size_t i = 0; i < count_; ++i)
    {
      const Vec3 size = axes_[i].cwiseAbs();
      reaches_[i] = half_.dot(size) + roundingUnits * size.maxCoeff();
    }
  }
  const Vec3 a = centered.relative(corners_[0]);
  const Vec3 b = centered.relative(corners_[1]);
  const Vec3 c = centered.relative(corners_[2]);
  for (std::size_t i = 0; i < count_; ++i)
  {
    const double p = axes_[i].dot(a);
    const double q = axes_[i].dot(b);
    const double r = axes_[i].dot(c);
    if (std::min({p, q, r}) > reaches_[i] || std::max({p, q, r}) < -reaches_[i])
    {
      return true;
    }
  }
  return false;
}

bool touches(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c)
{
  return TriangleBoxTest(a, b, c).touches(box);
}

bool touches(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b)
{
  constexpr auto margin = static_cast<std::int64_t>(roundingUnits);
  return !clipSegment(grown(box, margin), a, b).empty();
}

SegmentRange clipSegment(const LatticeBox& box, const LatticePoint& a, const LatticePoint& b)
{
  return clipLine(between(a, box.low), between(a, box.high), between(a, b), 1.0);
}

} // namespace atria
