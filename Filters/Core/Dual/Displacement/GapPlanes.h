// SPDX-License-Identifier: GPL-3.0-or-later
/// Moves grid points into gaps between sheets that run side by side.
#pragma once

#include "Dual/Displacement/MovingGrid.h"

namespace atria {

/// Moves points to the middle between two sheets that run side by side, within 45 degrees, through their leaves. A
/// plane of grid points is gap-free (no octant has points on both of its sides) if it holds all points within half the
/// sum of its normal's components (a standard digital plane; Reveillès 1991). In a stack of gaps, each thinner than
/// such a plane, each gap gets a plane: those around the middle of the stack, in order. Then points in none of these
/// planes are moved too, if a gap is no farther than the whole sum. Points that were moved already stay, and none moves
/// by more than the size of its smallest octant along any axis. After the first round only leaves around points that
/// moved are visited.
void enterGaps(MovingGrid& grid, const RunContext& context);

} // namespace atria
