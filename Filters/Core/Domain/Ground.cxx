// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/Ground.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

/// Returns the height of a triangle over a place; not a number beside it.
double heightIn(const Vec3& a, const Vec3& b, const Vec3& c, double x, double y)
{
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  const double u = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
  const double v = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
  constexpr double slack = 1e-9;
  const bool inside = area != 0.0 && u >= -slack && v >= -slack && u + v <= 1.0 + slack;
  return inside ? a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]) : std::nan("");
}

} // namespace

Ground::Ground(const TriangleSurface& of, const SurfaceFlags& isGround, double levelWithout)
    : surface(of), level(levelWithout)
{
  for (Index t = 0; t < surface.triangles.size(); ++t)
  {
    if (isGround[surface.surfaceIds[t]])
    {
      triangles.push_back(t);
      for (const Index p : surface.triangles[t])
      {
        box.extend(surface.points[p]);
      }
    }
  }
  bins = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(triangles.size()))), 1, 512);
  inBin.resize(bins * bins);
  for (const Index t : triangles)
  {
    Box3 own;
    for (const Index p : surface.triangles[t])
    {
      own.extend(surface.points[p]);
    }
    for (std::size_t i = binOf(own.min[0], 0); i <= binOf(own.max[0], 0); ++i)
    {
      for (std::size_t j = binOf(own.min[1], 1); j <= binOf(own.max[1], 1); ++j)
      {
        inBin[i * bins + j].push_back(t);
      }
    }
  }
}

std::size_t Ground::binOf(double value, int axis) const
{
  const double size = box.size()[axis];
  const double at = size > 0.0 ? (value - box.min[axis]) / size * static_cast<double>(bins) : 0.0;
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(bins - 1)));
}

double Ground::heightAt(double x, double y) const
{
  if (triangles.empty())
  {
    return level;
  }
  double height = std::nan("");
  for (const Index t : inBin[binOf(x, 0) * bins + binOf(y, 1)])
  {
    const auto& [a, b, c] = surface.triangles[t];
    height = std::fmax(height, heightIn(surface.points[a], surface.points[b], surface.points[c], x, y));
  }
  if (!std::isnan(height))
  {
    return height;
  }
  double nearest = std::numeric_limits<double>::infinity();
  for (const Index t : triangles)
  {
    for (const Index p : surface.triangles[t])
    {
      const Vec3& q = surface.points[p];
      const double distance = std::hypot(q[0] - x, q[1] - y);
      if (distance < nearest)
      {
        nearest = distance;
        height = q[2];
      }
    }
  }
  return height;
}

} // namespace atria
