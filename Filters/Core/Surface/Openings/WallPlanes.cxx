// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Openings/WallPlanes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>

namespace atria {

namespace {

Vec3 placeOf(const SurfaceModel& model, Index triangle, int i) { return toVector(model.corner(triangle, i)); }

WallPlane planeThrough(const SurfaceModel& model, Index triangle)
{
  WallPlane plane;
  plane.origin = placeOf(model, triangle, 0);
  plane.normal = model.normal(triangle).normalized();
  plane.u = plane.normal.unitOrthogonal();
  plane.v = plane.normal.cross(plane.u);
  return plane;
}

void add(const SurfaceModel& model, Index triangle, WallPlane& plane)
{
  plane.triangles.push_back(triangle);
  plane.area += 0.5 * model.normal(triangle).norm();
  plane.bounds.extend(model.bounds(triangle).min);
  plane.bounds.extend(model.bounds(triangle).max);
}

bool isIn(const WallPlane& plane, const SurfaceModel& model, const std::vector<Index>& triangles, double distance)
{
  return std::ranges::all_of(triangles, [&](Index t) {
    return std::abs(plane.heightOf(placeOf(model, t, 0))) <= distance &&
           std::abs(plane.heightOf(placeOf(model, t, 1))) <= distance &&
           std::abs(plane.heightOf(placeOf(model, t, 2))) <= distance;
  });
}

std::vector<std::vector<Index>> trianglesOfCharts(const SurfaceModel& model)
{
  std::vector<std::vector<Index>> charts;
  for (Index t = 0; t < model.triangles.size(); ++t)
  {
    if (model.domainSides[t] == SurfaceModel::noSide && !model.isTurnedSide(t))
    {
      charts.resize(std::max<std::size_t>(charts.size(), model.charts[t] + 1));
      charts[model.charts[t]].push_back(t);
    }
  }
  std::erase_if(charts, [](const std::vector<Index>& chart) { return chart.empty(); });
  return charts;
}

/// Planes binned roughly by their normals, whichever way they point.
class PlanesByNormal
{
public:
  explicit PlanesByNormal(std::vector<WallPlane>& found) : planes(found) {}

  /// Returns the plane in which a chart lies; planes.size() if there is none.
  std::size_t find(const SurfaceModel& model, const std::vector<Index>& chart, const Vec3& normal,
                   double distance) const
  {
    std::size_t best = planes.size();
    for (const double sign : {1.0, -1.0})
    {
      const Key key = keyOf(sign * normal);
      for (int i = 0; i < 27; ++i)
      {
        const auto found = byKey.find({key[0] + i % 3 - 1, key[1] + i / 3 % 3 - 1, key[2] + i / 9 - 1});
        for (const std::size_t p : found == byKey.end() ? std::vector<std::size_t>() : found->second)
        {
          best = p < best && isIn(planes[p], model, chart, distance) ? p : best;
        }
      }
    }
    return best;
  }

  void append(WallPlane plane)
  {
    byKey[keyOf(plane.normal)].push_back(planes.size());
    planes.push_back(std::move(plane));
  }

private:
  using Key = std::array<std::int64_t, 3>;
  static Key keyOf(const Vec3& normal)
  {
    constexpr double steps = 200.0; // charts of one plane differ by less than one step, even after rounding
    return {std::llround(steps * normal[0]), std::llround(steps * normal[1]), std::llround(steps * normal[2])};
  }

  std::vector<WallPlane>& planes;
  std::map<Key, std::vector<std::size_t>> byKey;
};

} // namespace

std::vector<WallPlane> findWallPlanes(const SurfaceModel& model, double distance)
{
  struct Chart
  {
    Index largest;
    double area;
    std::vector<Index> triangles;
  };
  std::vector<Chart> charts;
  const auto areaOf = [&](Index t) { return model.normal(t).norm(); };
  for (std::vector<Index>& triangles : trianglesOfCharts(model))
  {
    const Index largest = *std::ranges::max_element(triangles, {}, areaOf);
    if (isIn(planeThrough(model, largest), model, triangles, distance))
    {
      charts.push_back({largest, areaOf(largest), std::move(triangles)});
    }
  }
  // The largest triangle gives the plane most precisely.
  std::ranges::stable_sort(charts, std::ranges::greater(), &Chart::area);
  std::vector<WallPlane> planes;
  PlanesByNormal known(planes);
  for (const Chart& chart : charts)
  {
    const std::size_t at = known.find(model, chart.triangles, model.normal(chart.largest).normalized(), distance);
    if (at == planes.size())
    {
      known.append(planeThrough(model, chart.largest));
    }
    std::ranges::for_each(chart.triangles, [&](Index t) { add(model, t, planes[at]); });
  }
  for (WallPlane& plane : planes)
  {
    std::ranges::sort(plane.triangles);
  }
  return planes;
}

} // namespace atria
