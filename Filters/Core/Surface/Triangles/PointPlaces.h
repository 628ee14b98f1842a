// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds points that lie in one place.
#pragma once

#include "Support/Types.h"

#include <span>
#include <vector>

namespace atria {

/// Returns, for each point, the first point in the same place. With a `step` of zero, places are equal coordinates;
/// else points are in one place if their coordinates round to the same multiples of it. Points closer than a step on
/// either side of a border are then in different places. If the step is a power of ten well below the digits that
/// matter, borders fall between the numbers that people and programs write. Points must be finite, and within 2^51
/// steps of the origin. O(n) on average.
std::vector<Index> placesOf(std::span<const Vec3> points, double step);

/// Returns a step for models with these bounds: a part of their size that is less than any exporter's last digit. If
/// they lie so far from the origin that rounding in transforms costs more, it is that rounding.
double placeStep(const Box3& bounds);

} // namespace atria
