// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Grid/Predicates.h"
#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

struct DividedFace;

/// Points of a refinement closer than this many of its reaches become one. Points of a triangle are within the reach of
/// its plane; two that fall together in the projection it is triangulated in are never further apart.
inline constexpr std::int64_t weldReaches = 4;

/// On the way from p to q, the share `part / whole` of it; exact but for the last rounding.
LatticePoint partWay(const LatticePoint& p, const LatticePoint& q, Wide part, Wide whole);

/// Whether p is within `reach` of the segment and projects between its ends.
bool liesOnSegment(const LatticePoint& p, const LatticePoint& a, const LatticePoint& b, double reach);

/// Finds where the segments of a face cut each other, seen along `axis`, and cuts them there and at every point of the
/// face that lies on them. Points closer than the welding distance of the refinement are one, so that any number of
/// segments through one place have one point there. New points are appended to `points` and to the face's inside.
void cutSegments(std::vector<LatticePoint>& points, DividedFace& face, int axis, double reach);

} // namespace atria
