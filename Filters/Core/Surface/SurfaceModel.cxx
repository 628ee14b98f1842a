// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/SurfaceModel.h"

#include "Surface/FeatureGraph.h"
#include "Surface/Predicates.h"
#include "Surface/Weld.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

namespace atria {

namespace {

/// Puts coordinates that are within `distance` of a domain plane on it, so that what lies on a side does so exactly.
void snapToSides(std::vector<LatticePoint>& points, const GridFrame& frame, std::int64_t distance)
{
  for (LatticePoint& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const std::int64_t plane : {frame.domainLow[axis], frame.domainHigh[axis]})
      {
        if (std::abs(p[axis] - plane) <= distance)
        {
          p[axis] = plane;
        }
      }
    }
  }
}

std::int8_t sideOf(const SurfaceModel& model, const std::array<Index, 3>& t, const GridFrame& frame)
{
  for (int direction = 0; direction < 6; ++direction)
  {
    const int axis = axisOf(direction);
    const std::int64_t plane = isUpper(direction) ? frame.domainHigh[axis] : frame.domainLow[axis];
    if (model.points[t[0]][axis] == plane && model.points[t[1]][axis] == plane && model.points[t[2]][axis] == plane)
    {
      return static_cast<std::int8_t>(direction);
    }
  }
  return SurfaceModel::noSide;
}

bool hasArea(const SurfaceModel& model, const std::array<Index, 3>& t)
{
  if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
  {
    return false;
  }
  const LatticeNormal normal(model.points[t[0]], model.points[t[1]], model.points[t[2]]);
  return normal.n[0] != 0 || normal.n[1] != 0 || normal.n[2] != 0;
}

void addTriangles(SurfaceModel& model, const TriangleSurface& surface, const std::vector<Index>& pointOf,
                  const GridFrame& frame)
{
  std::set<std::array<Index, 3>> seen;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
  {
    std::array<Index, 3> t = surface.triangles[i];
    std::transform(t.begin(), t.end(), t.begin(), [&](Index p) { return pointOf[p]; });
    if (!hasArea(model, t))
    {
      ++model.degenerateTriangles;
      continue;
    }
    std::array<Index, 3> sorted = t;
    std::sort(sorted.begin(), sorted.end());
    if (!seen.insert(sorted).second)
    {
      ++model.duplicateTriangles;
      continue;
    }
    model.triangles.push_back(t);
    model.surfaceIds.push_back(surface.surfaceIds[i]);
    model.domainSides.push_back(sideOf(model, t, frame));
  }
}

} // namespace

Vec3 SurfaceModel::normal(Index triangle) const
{
  const LatticeNormal exact(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
  return {static_cast<double>(exact.n[0]), static_cast<double>(exact.n[1]), static_cast<double>(exact.n[2])};
}

SurfaceModel makeSurfaceModel(const TriangleSurface& surface, const GridFrame& frame, const FeatureOptions& options)
{
  const auto units = [&](double distance) {
    return static_cast<std::int64_t>(std::llround(distance / frame.latticeUnit()));
  };
  SurfaceModel model;
  model.names = surface.names;
  model.points.resize(surface.points.size());
  std::transform(surface.points.begin(), surface.points.end(), model.points.begin(),
                 [&](const Vec3& p) { return frame.toLattice(p); });
  const std::vector<Index> pointOf = weldPoints(model.points, units(options.weldDistance));
  snapToSides(model.points, frame, units(options.sideDistance));
  addTriangles(model, surface, pointOf, frame);
  findFeatures(model, frame, options);
  return model;
}

} // namespace atria
