// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

namespace atria {

/// In lattice units: what is this near is there, as points are rounded.
inline constexpr double latticeRounding = 2.0;
/// What lies on a surface and in a plane is found by going to the nearest place of either in turn, so often.
inline constexpr int projectionTurns = 8;

/// The point of a triangle, or segment, nearest to p (Ericson 2005, 5.1).
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// The nearest points of two segments, or of a segment and a triangle that it does not pass through.
struct NearestPair
{
  Vec3 first;
  Vec3 second;
  double distance() const { return (first - second).norm(); }
};
NearestPair nearestOfSegments(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b);
NearestPair nearestOfSegmentAndTriangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace atria
