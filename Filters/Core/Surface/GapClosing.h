// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/TriangleSoup.h"

#include <cstddef>

namespace atria {

struct GapReport
{
  /// Points that were moved.
  std::size_t closedGaps = 0;
  /// The longest of these moves, in lattice units.
  double largestMove = 0.0;
};

/// Moves points onto what they nearly touch, so that no gap narrower than `tolerance` (lattice units) is left between
/// them.
///
/// A point is moved onto the nearest point within the tolerance, else onto the nearest edge, else onto the nearest
/// face; the nearest pairs first. Points of a part that hangs together move onto a larger part (by the greatest face of
/// its box), then those of a larger one onto a smaller one. Points at free edges, those of one triangle, also move onto
/// their own part, but not onto what hangs together with them within three times the tolerance: details stay. A move is
/// left out that would take a point off a side of the domain it lies on, leave a triangle without area, or turn one by
/// more than 60 degrees. Points only move: triangles are not cut. O(n log^3 n + pairs of points and triangles that are
/// near).
GapReport closeGaps(TriangleSoup& soup, const GridFrame& frame, double tolerance);

} // namespace atria
