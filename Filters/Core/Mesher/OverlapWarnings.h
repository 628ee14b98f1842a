// SPDX-License-Identifier: GPL-3.0-or-later
/// Warns of surfaces that lie upon each other.
#pragma once

#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// Returns these sentences:
/// - one about all surfaces that lie upon each other if neither is smaller there;
/// - one for each wall that a face zone opens;
/// - one for each face zone that leaves the wall it lies on closed.
/// Areas below a tenth of the square of `size`, the finest size, do not count. Surfaces that only give way to a smaller
/// one cause no warning.
std::vector<std::string> warningsOfOverlaps(const SurfaceModel& model, double size);

} // namespace atria
