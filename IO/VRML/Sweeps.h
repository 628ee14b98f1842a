// SPDX-License-Identifier: GPL-3.0-or-later
/// ElevationGrid and Extrusion as triangles.
#pragma once

#include "SurfaceBuilder.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace atria::vrml {

struct ElevationGrid
{
  int xDimension = 0;
  int zDimension = 0;
  double xSpacing = 1.0;
  double zSpacing = 1.0;
  std::vector<double> height; ///< at least xDimension * zDimension, rows along x
  bool ccw = true;
};
/// Returns the triangles of a grid. Its cells are warped; each is cut along the shorter diagonal.
LocalSurface makeElevationGrid(const ElevationGrid& grid);

/// Returns a rotation around an axis of any length; the identity for an axis of none.
Eigen::Quaterniond rotationOf(const double* axisAndAngle);

struct Extrusion
{
  std::vector<Eigen::Vector2d> crossSection{{1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}}; ///< x and z
  std::vector<Vec3> spine{{0, 0, 0}, {0, 1, 0}};
  /// One per point of the spine; the last one stands for missing ones.
  std::vector<Eigen::Vector2d> scale{{1, 1}};
  std::vector<Eigen::Quaterniond> orientation{Eigen::Quaterniond::Identity()};
  bool beginCap = true;
  bool endCap = true;
  bool ccw = true;
};
/// Returns the triangles of an extrusion. Caps are triangulated whatever their outline. If a closed spine brings the
/// last cross-section onto the first, the two are joined and have no caps.
LocalSurface makeExtrusion(const Extrusion& extrusion);

} // namespace atria::vrml
