// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings of surfaces that lie upon each other.
#pragma once

#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// Returns a sentence about surfaces of which neither is smaller where they lie upon each other, one for each wall that
/// a face zone opens, and one for each face zone that leaves the wall it lies on closed. Areas below a tenth of the
/// square of `size`, the finest size, do not count. Surfaces that only give way to a smaller one are no reason to warn.
std::vector<std::string> warningsOfOverlaps(const SurfaceModel& model, double size);

} // namespace atria
