// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Direction most of the walls have: degrees in [-45, 45) from the x axis, counterclockwise seen from above, of walls
/// or of their normals, which are the same up to quarter turns. Walls are triangles within 5 degrees of upright,
/// counted by area. It is the direction of one of the triangles, not a mean of several walls. 0 without walls. O(n log
/// n).
double dominantWallAngle(const TriangleSurface& surface);

} // namespace atria
