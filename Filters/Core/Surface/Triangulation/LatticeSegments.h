// SPDX-License-Identifier: GPL-3.0-or-later
/// Cuts segments on a face at their crossings and at points on them.
#pragma once

#include "Grid/Predicates.h"
#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

struct DividedFace;

/// Number of reaches within which points of a refinement are merged. Points of a triangle are within the reach of its
/// plane. Two that fall together in the projection in which it is triangulated are never farther apart.
inline constexpr std::int64_t weldReaches = 4;

/// Returns the point at `part / whole` of the way from p to q; exact except for the last rounding.
LatticePoint partWay(const LatticePoint& p, const LatticePoint& q, Wide part, Wide whole);

/// True if p is within `reach` of the segment and projects between its ends.
bool liesOnSegment(const LatticePoint& p, const LatticePoint& a, const LatticePoint& b, double reach);

/// Finds where the segments of a face cut each other, seen along `axis`, and cuts them there and at every point of the
/// face that lies on them. Points closer than the welding distance of the refinement are merged, so that any number of
/// segments through one place have one point there. New points are appended to `points` and to the face's inside.
void cutSegments(std::vector<LatticePoint>& points, DividedFace& face, int axis, double reach);

} // namespace atria
