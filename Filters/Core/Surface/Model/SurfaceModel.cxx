// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Model/SurfaceModel.h"

#include "Grid/Predicates.h"
#include "Surface/Model/FeatureGraph.h"
#include "Surface/Repair/Autorefine.h"
#include "Surface/Triangles/Weld.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

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

bool hasArea(const TriangleSoup& soup, const std::array<Index, 3>& t)
{
  const LatticeNormal normal(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
  return normal.n[0] != 0 || normal.n[1] != 0 || normal.n[2] != 0;
}

/// Places whose points became one with a point at another place; points repeated in one place are no fault.
std::size_t countWelded(const std::vector<LatticePoint>& points, const std::vector<Index>& pointOf)
{
  std::vector<LatticePoint> left;
  for (Index p = 0; p < pointOf.size(); ++p)
  {
    if (points[p] != points[pointOf[p]])
    {
      left.push_back(points[p]);
    }
  }
  std::sort(left.begin(), left.end());
  return static_cast<std::size_t>(std::unique(left.begin(), left.end()) - left.begin());
}

/// As drawn, but what bounds a cell zone after all other surfaces, and sides of the domain last: where triangles
/// coincide the first stays, and a wall without it would have a hole.
std::vector<Index> orderOfTriangles(const TriangleSurface& surface, const std::vector<SurfaceKind>& kinds)
{
  const auto precedence = [&](Index triangle) {
    const Index surfaceId = surface.surfaceIds[triangle];
    return surfaceId >= kinds.size() ? 2 : kinds[surfaceId] == SurfaceKind::cellZone ? 1 : 0;
  };
  std::vector<Index> order(surface.triangles.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return precedence(a) < precedence(b); });
  return order;
}

/// The triangles on the lattice, without those that have no area or repeat an earlier one.
TriangleSoup weldedSoup(const TriangleSurface& surface, const std::vector<SurfaceKind>& kinds, const GridFrame& frame,
                        std::int64_t weldDistance, std::int64_t sideDistance, SurfaceRepairReport& report)
{
  TriangleSoup soup;
  soup.points.resize(surface.points.size());
  std::transform(surface.points.begin(), surface.points.end(), soup.points.begin(),
                 [&](const Vec3& p) { return frame.toLattice(p); });
  const std::vector<Index> pointOf = weldPoints(soup.points, weldDistance);
  report.weldedPoints = countWelded(soup.points, pointOf);
  snapToSides(soup.points, frame, sideDistance);
  const std::vector<Index> order = orderOfTriangles(surface, kinds);
  for (Index i = 0; i < order.size(); ++i)
  {
    std::array<Index, 3> t = surface.triangles[order[i]];
    std::transform(t.begin(), t.end(), t.begin(), [&](Index p) { return pointOf[p]; });
    if (hasArea(soup, t))
    {
      soup.add(t, surface.surfaceIds[order[i]], i);
    }
  }
  report.degenerateTriangles = surface.triangles.size() - soup.triangles.size();
  report.duplicateTriangles = dropRepeated(soup);
  return soup;
}

} // namespace

Vec3 SurfaceModel::normal(Index triangle) const
{
  const LatticeNormal exact(corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
  return {static_cast<double>(exact.n[0]), static_cast<double>(exact.n[1]), static_cast<double>(exact.n[2])};
}

SurfaceModel makeSurfaceModel(const TriangleSurface& surface, const GridFrame& frame, const FeatureOptions& options,
                              const RunContext& context)
{
  const auto units = [&](double distance) {
    return static_cast<std::int64_t>(std::llround(distance / frame.latticeUnit()));
  };
  SurfaceModel model;
  model.names = surface.names;
  model.kinds = options.kinds;
  SurfaceRepairOptions repair;
  repair.weldDistance = units(options.weldDistance);
  repair.gapTolerance = options.gapTolerance / frame.latticeUnit();
  repair.clusters = {options.featureAngle, options.finerPlaces};
  repair.smallPartSize = options.smallPartSize;
  repair.keptSurfaces = options.keptSurfaces;
  TriangleSoup soup =
      weldedSoup(surface, options.kinds, frame, repair.weldDistance, units(options.sideDistance), model.repair);
  repairSurface(soup, frame, repair, model.repair, context);
  model.points = std::move(soup.points);
  model.triangles = std::move(soup.triangles);
  model.surfaceIds = std::move(soup.surfaceIds);
  for (const auto& t : model.triangles)
  {
    model.domainSides.push_back(sideOf(model, t, frame));
  }
  findFeatures(model, frame, options, context.executor);
  return model;
}

} // namespace atria
