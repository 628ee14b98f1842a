// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds nearest points of triangles and segments.
#pragma once

#include "Support/Types.h"

#include <optional>

namespace atria {

/// Distance in lattice units up to which places are the same, as points are rounded.
inline constexpr double latticeRounding = 2.0;
/// Distance in octants up to which parts are in one place or plane, as walls are drawn.
inline constexpr double coincidentRatio = 1e-3;
/// Number of turns in which a point goes to the nearest place of a surface and of a plane in turn, to find one on both.
inline constexpr int projectionTurns = 8;

/// Returns the point of a triangle, or segment, nearest to p (Ericson 2005, 5.1).
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);
Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b);

/// The nearest to p of all offered places, and the first of equally near ones.
struct NearestPlace
{
  Vec3 p;
  Vec3 at = Vec3::Zero();
  double squaredDistance = std::numeric_limits<double>::infinity();

  /// Takes a place if it is nearer than all before. Returns true if it was.
  bool offer(const Vec3& place)
  {
    const double squared = (place - p).squaredNorm();
    if (squared >= squaredDistance)
    {
      return false;
    }
    at = place;
    squaredDistance = squared;
    return true;
  }
  bool found() const { return squaredDistance < std::numeric_limits<double>::infinity(); }
  std::optional<Vec3> place() const { return found() ? std::optional(at) : std::nullopt; }
};

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
