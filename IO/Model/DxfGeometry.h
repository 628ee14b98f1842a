// SPDX-License-Identifier: GPL-3.0-or-later
/// Coordinate systems, arcs and units of DXF.
#pragma once

#include "DxfFile.h"

#include <Eigen/Geometry>

#include <numbers>
#include <string_view>
#include <vector>

namespace atria::model::dxf {

inline constexpr double radians = std::numbers::pi / 180.0; ///< per degree

/// Returns the object coordinate system of an entity's extrusion direction (DXF's arbitrary axis algorithm).
Eigen::Affine3d objectSystem(const Entity& entity);

/// A point of a polyline, and the tangent of a quarter of the angle of the arc from it to the next.
struct Corner
{
  Vec3 at;
  double bulge = 0.0;
};

/// Returns the corners, with points on the arcs between them.
std::vector<Vec3> withArcs(const std::vector<Corner>& corners, bool isClosed);

/// Returns the meters of a unit by its number in the header; 0 for none.
double metersOf(std::string_view unit);

} // namespace atria::model::dxf
