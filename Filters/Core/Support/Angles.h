// SPDX-License-Identifier: GPL-3.0-or-later
/// Angles, in degrees unless stated otherwise. Constants are slightly off round numbers: walls are drawn at round
/// angles, and rounding should not decide what they are.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atria {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
inline double cosOfDegrees(double degrees) { return std::cos(radians(degrees)); }
/// Cosine above which a direction runs along another one rather than across it.
inline const double alongCosine = cosOfDegrees(45.01);
/// Returns the angle of a cosine in degrees, 0 to 180. Clamps cosines that rounding took beyond 1 or -1.
inline double degreesOfCosine(double cosine)
{
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

} // namespace atria
