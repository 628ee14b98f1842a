// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Displacement/MovingGrid.h"

namespace atria {

/// Moves points onto the middle between two sheets that run side by side, within 45 degrees, through their leaves. A
/// plane of grid points is gap-free, no octant having points on both its sides, if it holds all that are within half
/// the sum of its normal's components (a standard digital plane; Reveillès 1991). Of a stack of gaps one upon the
/// other, each thinner than such a plane, each gets a plane: those about the middle of the stack, in order. Then points
/// that are in none of these planes are moved too, if a gap is no farther than the whole sum. Points that were moved
/// already stay, and none moves by more than the size of its smallest octant along any axis. After the first round only
/// leaves about points that moved are looked at.
void enterGaps(MovingGrid& grid, const RunContext& context);

} // namespace atria
