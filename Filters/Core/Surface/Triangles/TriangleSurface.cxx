// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Triangles/TriangleSurface.h"

#include "Support/Error.h"

#include <Eigen/Geometry>

#include <cmath>

namespace atria {

double areaOf(const TriangleSurface& surface)
{
  double area = 0.0;
  for (const auto& t : surface.triangles)
  {
    const Vec3& p = surface.points[t[0]];
    area += 0.5 * (surface.points[t[1]] - p).cross(surface.points[t[2]] - p).norm();
  }
  if (!std::isfinite(area))
  {
    throw Error("the model is so large that its area is not finite: check its unit and coordinates");
  }
  if (!(area > 0.0))
  {
    throw Error("no face of the model has an area: all its triangles are lines or points. Export it with its faces");
  }
  return area;
}

} // namespace atria
