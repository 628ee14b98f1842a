// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/PolygonTriangulation.h"


namespace atria {
PolygonTriangles triangulatePolygon(std::span<const Vec3> points, std::span<const Index> polygon)
{
  PolygonTriangles out;
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    out.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  }
  (void)points;
  return out;
}
} // namespace atria
