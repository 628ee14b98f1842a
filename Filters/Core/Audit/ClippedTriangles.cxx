// SPDX-License-Identifier: GPL-3.0-or-later
#include "Audit/ClippedTriangles.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace atria {

namespace {

Box3 widened(const Box3& box, double by) { return {box.min.array() - by, box.max.array() + by}; }

} // namespace

ConvexRegion::ConvexRegion(const Box3& box, double tolerance) : bounds_(widened(box, tolerance))
{
  for (int axis = 0; axis < 3; ++axis)
  {
    planes_.push_back({-Vec3::Unit(axis), -bounds_.min[axis]});
    planes_.push_back({Vec3::Unit(axis), bounds_.max[axis]});
  }
}

ConvexRegion::ConvexRegion(const PlacedPrism& prism, double tolerance)
{
  planes_.push_back({-Vec3::UnitZ(), tolerance - prism.bounds.min[2]});
  planes_.push_back({Vec3::UnitZ(), prism.bounds.max[2] + tolerance});
  for (const PrismSide& side : prism.sides())
  {
    planes_.push_back({{side.normal[0], side.normal[1], 0.0}, side.offset + tolerance});
  }
  bounds_ = prism.isBox() ? widened(prism.bounds, tolerance) : Box3{};
}

ConvexRegion::Part ConvexRegion::within(const Vec3& a, const Vec3& b, const Vec3& c, double level) const
{
  std::vector<Vec3> polygon{a, b, c};
  const auto isInside = [&](const Vec3& p) {
    return (p.array() >= bounds_.min.array()).all() && (p.array() <= bounds_.max.array()).all();
  };
  if (!std::ranges::all_of(polygon, isInside))
  {
    std::vector<Vec3> kept;
    for (const Plane& plane : planes_)
    {
      kept.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i)
      {
        const Vec3& p = polygon[i];
        const Vec3& q = polygon[(i + 1) % polygon.size()];
        const double here = plane.beyond(p);
        const double there = plane.beyond(q);
        if (here <= 0.0)
        {
          kept.push_back(p);
        }
        if ((here < 0.0 && there > 0.0) || (here > 0.0 && there < 0.0))
        {
          kept.push_back(p + here / (here - there) * (q - p));
        }
      }
      polygon.swap(kept);
    }
  }
  Part part;
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    const double area = 0.5 * (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]).norm();
    part.area += area;
    part.heightTimesArea += area * ((polygon[0][2] + polygon[i - 1][2] + polygon[i][2]) / 3.0 - level);
  }
  return part;
}

DrawnSurfaces measureDrawn(const TriangleSurface& surface, const PlacedPrism& domain, double tolerance)
{
  const ConvexRegion region(domain, tolerance);
  DrawnSurfaces drawn;
  drawn.areas.resize(surface.names.size(), 0.0);
  drawn.outside.resize(surface.names.size(), 0.0);
  std::vector<Box3> bounds(surface.names.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto at = [&](int i) { return domain.axes.fromModel(surface.points[surface.triangles[t][i]]); };
    if (const Index id = surface.surfaceIds[t]; id < drawn.areas.size())
    {
      const double within = region.within(at(0), at(1), at(2), 0.0).area;
      drawn.areas[id] += within;
      drawn.outside[id] += std::max(0.0, 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm() - within);
      std::ranges::for_each(surface.triangles[t], [&](Index p) { bounds[id].extend(surface.points[p]); });
    }
  }
  std::ranges::transform(bounds, std::back_inserter(drawn.extents),
                         [](const Box3& box) { return box.empty() ? 0.0 : box.size().norm(); });
  return drawn;
}

} // namespace atria
