// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the planes in which plane walls of a model lie.
#pragma once

#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// Plane charts that lie in one plane. Places in it have two coordinates, counterclockwise seen from the side the
/// normal points to.
struct WallPlane
{
  Vec3 origin;
  Vec3 normal;
  Vec3 u;
  Vec3 v;
  std::vector<Index> triangles; ///< rising
  double area = 0.0;
  /// In lattice units.
  Box3 bounds;

  double heightOf(const Vec3& p) const { return normal.dot(p - origin); }
  Eigen::Vector2d placeOf(const Vec3& p) const { return {u.dot(p - origin), v.dot(p - origin)}; }
  Vec3 pointAt(const Eigen::Vector2d& place) const { return origin + place[0] * u + place[1] * v; }
};

/// Returns the planes of walls. All points of a plane's triangles are within `distance` (lattice units) of it. Charts
/// that are not plane, and those on sides of the domain, are in none.
std::vector<WallPlane> findWallPlanes(const SurfaceModel& model, double distance);

} // namespace atria
