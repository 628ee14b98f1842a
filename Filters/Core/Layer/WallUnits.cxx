// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/WallUnits.h"

namespace atria {

double heightAtYPlus(double yPlus, double speed) { return 2.0 * yPlus * viscosityOfAir / (frictionRatio * speed); }

double yPlusOf(double height, double speed) { return 0.5 * height * frictionRatio * speed / viscosityOfAir; }

} // namespace atria
