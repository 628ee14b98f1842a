// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Model/SurfaceModel.h"

#include "Grid/Predicates.h"
#include "Surface/Model/FeatureGraph.h"
#include "Surface/Repair/Autorefine.h"
#include "Surface/Repair/Overlaps.h"
#include "Surface/Triangles/Weld.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace atria {

namespace {

/// Puts coordinates within `distance` of a domain plane on it, so that points on a side lie there exactly.
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

/// Returns the number of places whose points were merged with a point at another place. Points repeated in one place
/// are no fault.
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

/// Returns the triangles on the lattice, without those that have no area.
TriangleSoup weldedSoup(const TriangleSurface& surface, const GridFrame& frame, std::int64_t weldDistance,
                        std::int64_t sideDistance, SurfaceRepairReport& report)
{
  TriangleSoup soup;
  soup.points.resize(surface.points.size());
  std::transform(surface.points.begin(), surface.points.end(), soup.points.begin(),
                 [&](const Vec3& p) { return frame.toLattice(p); });
  const std::vector<Index> pointOf = weldPoints(soup.points, weldDistance);
  report.weldedPoints = countWelded(soup.points, pointOf);
  snapToSides(soup.points, frame, sideDistance);
  for (Index i = 0; i < surface.triangles.size(); ++i)
  {
    std::array<Index, 3> t = surface.triangles[i];
    std::transform(t.begin(), t.end(), t.begin(), [&](Index p) { return pointOf[p]; });
    if (hasArea(soup, t))
    {
      soup.add(t, surface.surfaceIds[i], i);
    }
  }
  report.degenerateTriangles = surface.triangles.size() - soup.triangles.size();
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
  TriangleSoup soup = weldedSoup(surface, frame, repair.weldDistance, units(options.sideDistance), model.repair);
  Overlaps overlaps(surface, options.kinds, frame);
  repair.overlaps = &overlaps;
  model.repair.duplicateTriangles = dropRepeated(soup, &overlaps);
  repairSurface(soup, frame, repair, model.repair, context);
  model.repair.shared = overlaps.shared();
  model.points = std::move(soup.points);
  model.triangles = std::move(soup.triangles);
  model.surfaceIds = std::move(soup.surfaceIds);
  for (const auto& t : model.triangles)
  {
    model.domainSides.push_back(sideOf(model, t, frame));
  }
  model.featureAngle = options.featureAngle;
  findFeatures(model, frame, context.executor);
  return model;
}

} // namespace atria
