// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the domain by the rules of wind engineering.
#pragma once

#include "Domain/Ground.h"
#include "Grid/Prism.h"

#include <optional>

namespace atria {

/// Distances from the buildings, in building heights, after COST 732 (Franke et al. 2007) and AIJ (Tominaga et al.
/// 2008).
struct WindRules
{
  double inletHeights = 5.0;
  double sideHeights = 5.0;
  double topHeights = 5.0; ///< above the highest point of the buildings
  double outletHeights = 15.0;
  double mostBlockage = 0.03;
};

/// Surfaces of a model that are no buildings, and the height of the ground if it does not follow from them.
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
  /// Factor by which the distances to the sides and the top were increased to keep the blockage.
  double widened = 1.0;
};

/// Returns the domain for wind toward `windAngle` (see Placement), which blows along the box's x axis: xMin is the
/// inlet. A prism of other than four sides serves wind from all around. Its sides touch a circle around the buildings'
/// middle, at the distance of the outlet from the circle that holds the buildings. Its blockage is the largest one for
/// wind square to a side. Buildings are all surfaces that are not ground. Throws Error if there are none or they have
/// no height.
WindDomain windDomain(const TriangleSurface& surface, const WindGround& ground, double windAngle, int sideCount = 4,
                      const WindRules& rules = {});

/// Returns bottom and top of the same domain if its sides are given: the lowest ground, and 5 H above the highest
/// point. Throws Error as windDomain() does.
std::array<double, 2> windHeights(const TriangleSurface& surface, const WindGround& ground,
                                  const WindRules& rules = {});

/// Returns the bounds along `axes` of all surfaces that are not ground.
Box3 boundsOfBuildings(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes);

/// Returns the floor if one is given, else the lowest ground, else the buildings' lowest point; 0 without any.
double lowestGround(const TriangleSurface& surface, const WindGround& ground);

/// Returns the largest height of a point of the buildings above the ground below it; 0 without buildings.
double heightOfBuildings(const TriangleSurface& surface, const WindGround& ground);

/// Returns the area of the buildings' projection along the x axis of `axes`, above the height `floor`. Each place
/// counts once, however many walls stand behind each other. The integral along y is taken in 2048 strips. A model
/// without more projected points than that also has strips between these points: it is exact unless projected edges
/// cross between them.
double frontalArea(const TriangleSurface& surface, const SurfaceFlags& isGround, const Placement& axes, double floor);

} // namespace atria
