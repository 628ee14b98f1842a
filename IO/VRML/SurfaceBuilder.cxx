// SPDX-License-Identifier: GPL-3.0-or-later
#include "SurfaceBuilder.h"

namespace atria::vrml {

void SurfaceBuilder::polygon(std::span<const Index> ids)
{
  triangulatePolygon(surface.points, ids, cut);
  for (const auto& t : cut.triangles)
  {
    triangle(t[0], t[1], t[2]);
  }
  ++polygons;
  flat += cut.triangles.empty() ? 1 : 0;
  crossing += cut.simple ? 0 : 1;
}

} // namespace atria::vrml
