// SPDX-License-Identifier: GPL-3.0-or-later
#include "Domain/PlumbLines.h"

#include "Surface/Search/Distance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace atria {

namespace {

/// Least part of a triangle's area seen from above. Steeper triangles have no height over a place.
constexpr double leastLevel = 1e-6;

std::vector<Box3> boxesOf(const TriangleSurface& surface, const std::vector<Index>& triangles)
{
  std::vector<Box3> boxes(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
  {
    for (const Index p : surface.triangles[triangles[i]])
    {
      boxes[i].extend(surface.points[p]);
    }
  }
  return boxes;
}

/// Returns twice the triangle's area vector.
Vec3 areaOf(const TriangleSurface& surface, Index triangle)
{
  const auto& [a, b, c] = surface.triangles[triangle];
  return (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]);
}

} // namespace

PlanBins::PlanBins(const std::vector<Box3>& boxes)
{
  std::size_t count = 0;
  for (const Box3& box : boxes)
  {
    if (!box.empty())
    {
      bounds.extend(box.min);
      bounds.extend(box.max);
      ++count;
    }
  }
  constexpr std::size_t mostBins = 1024;
  constexpr std::size_t entriesEach = 16;
  constexpr std::size_t fewEntries = 1 << 20;
  bins = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(count))), 1, mostBins);
  while (bins > 1 && entriesOf(boxes) > entriesEach * count + fewEntries)
  {
    bins /= 2;
  }
  begins.assign(bins * bins + 1, 0);
  const auto eachBin = [&](const Box3& box, auto&& visit) {
    for (std::size_t i = binOf(box.min[0], 0); !box.empty() && i <= binOf(box.max[0], 0); ++i)
    {
      for (std::size_t j = binOf(box.min[1], 1); j <= binOf(box.max[1], 1); ++j)
      {
        visit(i * bins + j);
      }
    }
  };
  for (const Box3& box : boxes)
  {
    eachBin(box, [&](std::size_t bin) { ++begins[bin + 1]; });
  }
  for (std::size_t bin = 1; bin < begins.size(); ++bin)
  {
    begins[bin] += begins[bin - 1];
  }
  numbers.resize(begins.back());
  std::vector<std::size_t> next(begins.begin(), begins.end() - 1);
  for (std::size_t i = 0; i < boxes.size(); ++i)
  {
    eachBin(boxes[i], [&](std::size_t bin) { numbers[next[bin]++] = static_cast<Index>(i); });
  }
}

std::size_t PlanBins::binOf(double value, int axis) const
{
  const double size = bounds.max[axis] - bounds.min[axis];
  const double at = size > 0.0 ? (value - bounds.min[axis]) / size * static_cast<double>(bins) : 0.0;
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(bins - 1)));
}

std::size_t PlanBins::entriesOf(const std::vector<Box3>& boxes) const
{
  std::size_t entries = 0;
  for (const Box3& box : boxes)
  {
    if (!box.empty())
    {
      entries += (binOf(box.max[0], 0) - binOf(box.min[0], 0) + 1) * (binOf(box.max[1], 1) - binOf(box.min[1], 1) + 1);
    }
  }
  return entries;
}

PlumbLines::PlumbLines(const TriangleSurface& of, std::vector<Index> some)
    : surface(of), triangles(std::move(some)), bins(boxesOf(surface, triangles))
{
}

void PlumbLines::find(double x, double y, std::vector<PlumbHit>& hits) const
{
  hits.clear();
  const Vec3 at(x, y, 0.0);
  bins.eachNear(at, at, [&](Index i) {
    const auto& [ia, ib, ic] = surface.triangles[triangles[i]];
    const Vec3& a = surface.points[ia];
    const Vec3& b = surface.points[ib];
    const Vec3& c = surface.points[ic];
    const Vec3 normal = (b - a).cross(c - a);
    if (std::abs(normal[2]) <= leastLevel * normal.norm())
    {
      return;
    }
    const double u = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / normal[2];
    const double v = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / normal[2];
    constexpr double slack = 1e-9;
    if (u >= -slack && v >= -slack && u + v <= 1.0 + slack)
    {
      hits.push_back({a[2] + u * (b[2] - a[2]) + v * (c[2] - a[2]), triangles[i]});
    }
  });
  std::ranges::sort(hits, [](const PlumbHit& l, const PlumbHit& r) {
    return std::pair(l.height, l.triangle) < std::pair(r.height, r.triangle);
  });
}

bool PlumbLines::isUprightBelow(Index triangle, const Vec3& p, double bottom, double reach) const
{
  const Vec3 area = areaOf(surface, triangle);
  const double norm = area.norm();
  if (!(norm > 0.0) || std::abs(area[2]) > leastLevel * norm)
  {
    return false;
  }
  const auto& [a, b, c] = surface.triangles[triangle];
  const Vec3 foot(p[0], p[1], bottom);
  const auto& points = surface.points;
  return std::abs(area.dot(p - points[a])) <= reach * norm &&
         nearestOfSegmentAndTriangle(p, foot, points[a], points[b], points[c]).distance() <= reach;
}

} // namespace atria
