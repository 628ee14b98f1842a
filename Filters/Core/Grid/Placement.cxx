// SPDX-License-Identifier: GPL-3.0-or-later
#include "Grid/Placement.h"

namespace atria {

PlacedBox turnedAboutMiddle(const Box3& box, double degrees)
{
  PlacedBox out{Placement(degrees), box};
  if (out.axes.angle() != 0.0 && !box.empty())
  {
    const Vec3 middle = out.axes.fromModel(box.center());
    out.bounds = {middle - 0.5 * box.size(), middle + 0.5 * box.size()};
  }
  return out;
}

Box3 boundsAlong(const Placement& axes, const PlacedBox& box)
{
  const Placement relative(axes.angle() - box.axes.angle());
  Box3 out;
  for (int corner = 0; corner < 8; ++corner)
  {
    out.extend(relative.fromModel({corner & 1 ? box.bounds.max[0] : box.bounds.min[0],
                                   corner & 2 ? box.bounds.max[1] : box.bounds.min[1],
                                   corner & 4 ? box.bounds.max[2] : box.bounds.min[2]}));
  }
  return out;
}

} // namespace atria
