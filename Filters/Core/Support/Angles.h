// SPDX-License-Identifier: GPL-3.0-or-later
/// Angles, which are in degrees wherever nothing else is said. Constants are a little off round numbers: walls are
/// drawn at these, and rounding should not decide what they are.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace atria {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
inline double cosOfDegrees(double degrees) { return std::cos(radians(degrees)); }
/// Above, a direction runs along another one rather than across it.
inline const double alongCosine = cosOfDegrees(45.01);
/// 0 to 180; what rounding takes beyond 1 or -1 counts as these.
inline double degreesOfCosine(double cosine)
{
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

} // namespace atria
