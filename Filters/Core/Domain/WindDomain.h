// SPDX-License-Identifier: GPL-3.0-or-later
/// The domain by the rules of wind engineering.
#pragma once

#include "Domain/Ground.h"
#include "Grid/Prism.h"

#include <optional>

namespace atria {

/// Distances from the buildings in their heights, after COST 732 (Franke et al. 2007) and AIJ (Tominaga et al. 2008).
struct WindRules
{
  double inletHeights = 5.0;
  double sideHeights = 5.0;
  double topHeights = 5.0; ///< above the highest point of the buildings
  double outletHeights = 15.0;
  double mostBlockage = 0.03;
};

/// What of a model is no building, and the height of the ground where that is not to follow from these surfaces.
struct WindGround
{
  const SurfaceFlags& isGround;
  std::optional<double> floor = {};
};

struct WindDomain
{
  PlacedBox box;
  /// Bounds of the buildings along the box's axes.
  Box3 buildings;
  /// Largest height of a point of the buildings above the ground below it.
  double height = 0.0;
  /// Factor by which the distances to the sides and the top were made larger to keep the blockage.
  double widened = 1.0;
};

/// The domain for wind towards `windAngle` (see Placement): along the box's x axis, so that xMin is the inlet. For a
/// prism of other than four sides it is that for wind from all around: a circle about the buildings' middle, with the
/// distance of the outlet from the circle that holds them, touches its sides; the blockage is that of the wind square
/// to any of them. Buildings are all surfaces that are no ground.
/// Throws Error where there are none or they have no height.
WindDomain windDomain(const TriangleSurface& surface, const WindGround& ground, double windAngle, int sideCount = 4,
                      const WindRules& rules = {});

/// Bottom and top of the same domain where its sides are given: the lowest ground, and 5 H above the highest point.
/// Throws Error as windDomain().
std::array<double, 2> windHeights(const TriangleSurface& surface, const WindGround& ground,
                                  const WindRules& rules = {});

/// Bounds along `axes` of all surfaces that are no ground.
Box3 boundsOfBuildings(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes);

/// The floor where one is given, else the lowest ground, else the buildings' lowest point; 0 without any.
double lowestGround(const TriangleSurface& surface, const WindGround& ground);

/// Largest height of a point of the buildings above the ground below it; 0 without buildings.
double heightOfBuildings(const TriangleSurface& surface, const WindGround& ground);

/// Area of the buildings' projection along `axes`' x, above the height `floor`: each place counts once, however
/// many walls stand behind each other. Integrated along y in 2048 strips and, of a model without more of them, between
/// the projected points: exact then where projected edges do not cross between these.
double frontalArea(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes, double floor);

} // namespace atria
