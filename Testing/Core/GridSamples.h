// SPDX-License-Identifier: GPL-3.0-or-later
/// Frames of octants and steps on the lattice, for tests of grids.
#pragma once

#include "SizingFrame.h"

namespace atria::testing {

inline LatticePoint moved(LatticePoint place, int direction, std::int64_t by)
{
  place.at(static_cast<std::size_t>(axisOf(direction))) += isUpper(direction) ? by : -by;
  return place;
}

} // namespace atria::testing
