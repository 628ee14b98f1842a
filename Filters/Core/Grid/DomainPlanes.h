// SPDX-License-Identifier: GPL-3.0-or-later
/// Puts positions into planes of the domain's box.
#pragma once

#include "Grid/GridFrame.h"

namespace atria {

/// Returns a position moved into domain planes (by Direction, as bits; see GridFrame::domainPlanes), and into the
/// domain box.
inline Vec3 onDomainPlanes(Vec3 p, unsigned planes, const GridFrame& frame)
{
  for (int direction = 0; direction < 6; ++direction)
  {
    if ((planes >> direction & 1) != 0)
    {
      p[axisOf(direction)] = frame.planeOf(direction);
    }
  }
  return p.cwiseMax(frame.domain.min).cwiseMin(frame.domain.max);
}

} // namespace atria
