// SPDX-License-Identifier: GPL-3.0-or-later
/// Clips a line to a box.
#pragma once

#include "Surface/Search/BoxTests.h"

#include <algorithm>

namespace atria {

/// Returns the parameters in [0, farthest] of the part of a line in the box from `low` to `high`, which are relative to
/// the start of the line (Kay and Kajiya 1986).
inline SegmentRange clipLine(const Vec3& low, const Vec3& high, const Vec3& along, double farthest)
{
  SegmentRange range{0.0, farthest};
  for (int axis = 0; axis < 3; ++axis)
  {
    if (along[axis] == 0.0)
    {
      if (low[axis] > 0.0 || high[axis] < 0.0)
      {
        return {1.0, 0.0};
      }
      continue;
    }
    range.begin = std::max(range.begin, std::min(low[axis] / along[axis], high[axis] / along[axis]));
    range.end = std::min(range.end, std::max(low[axis] / along[axis], high[axis] / along[axis]));
  }
  return range;
}

} // namespace atria
