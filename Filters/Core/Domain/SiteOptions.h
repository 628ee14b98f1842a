// SPDX-License-Identifier: GPL-3.0-or-later
/// Options for the domain around a model, its terrain, and the axes of the grid.
#pragma once

#include "Support/Types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace atria {

enum class DomainMode : std::uint8_t
{
  surfaces, ///< the bounds of the surfaces
  bounds,   ///< given
  site,     ///< above the site surface
  automatic ///< from the buildings' height; see WindDomain.h
};

/// Axes along which the grid stands.
enum class GridAlignment : std::uint8_t
{
  axes,  ///< the model's
  walls, ///< most walls
  domain
};

struct SiteOptions
{
  DomainMode mode = DomainMode::automatic;
  /// Used in mode `bounds`.
  Box3 bounds;
  /// Upright sides of the domain: 4 of a box, else of a polygon that fills the bounds (see PlacedPrism). In mode
  /// `automatic` of other than 4 it serves wind from all around (see WindDomain.h).
  int domainSides = 4;
  /// Corners of the domain seen from above, in the model's x and y; see PlacedPrism. If there are any, the mode says
  /// only where bottom and top are, and the domain has neither other sides nor an angle.
  std::vector<Vec2> polygon;
  /// Angle of the domain in degrees (see Placement). Given bounds are turned around their middle. A domain from
  /// surfaces or site is the smallest box along the turned axes. Not in mode `automatic`.
  double domainAngle = 0.0;
  /// Direction in which the wind blows, in mode `automatic`; see Placement.
  double windAngle = 0.0;
  std::string site = "Site";
  /// Pattern of the names of terrain surfaces; see terrainSurfaces.
  std::string terrain;
  GridAlignment alignment = GridAlignment::axes;
  /// Names of more surfaces that are ground, as the model's file says; see groundOf.
  std::vector<std::string> grounds;
  /// Largest gap below a body that is let down to the ground, as a part of its height; see groundModel. 0 lets down
  /// none.
  double groundSnapRatio = 0.25;
  /// Height of the ground; if not given, that of the lowest ground surface or of the lowest point.
  std::optional<double> floor;
};

} // namespace atria
