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

} // namespace atria
