// SPDX-License-Identifier: GPL-3.0-or-later
/// Heights of elements on walls in viscous lengths of air (y+), in which wall functions count.
#pragma once

namespace atria {

/// Kinematic viscosity of air at 15 degrees Celsius, m2/s.
inline constexpr double viscosityOfAir = 1.5e-5;
/// Friction velocity over the speed of the air that passes the wall, a round number: log laws have it 3,000 roughness
/// lengths off a wall, flat plates (friction coefficient 0.005) some meters behind their edge.
inline constexpr double frictionRatio = 0.05;

/// Returns the height, in meters, of an element whose middle is `yPlus` viscous lengths off the wall. `speed` is that
/// of the air that passes the wall, in m/s. Both are above 0.
double heightAtYPlus(double yPlus, double speed);

/// Returns the viscous lengths from the wall to the middle of an element of this height, in meters.
double yPlusOf(double height, double speed);

} // namespace atria
