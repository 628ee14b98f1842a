// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the direction of a model's walls.
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Returns the direction of most walls or of their normals, which are the same up to quarter turns: degrees in [-45,
/// 45) from the x axis, counterclockwise seen from above. Walls are triangles within 5 degrees of upright, counted by
/// area. The result is the direction of one of the triangles, not a mean of several walls. It is 0 without walls. O(n
/// log n).
double dominantWallAngle(const TriangleSurface& surface);

} // namespace atria
