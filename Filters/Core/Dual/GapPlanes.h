// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/MovingGrid.h"

namespace atria {

/// Moves points onto the middle between two sheets that run side by side through their leaves. A plane of grid points
/// is gap-free, no octant having points on both its sides, if it holds all that are within half the sum of its
/// normal's components (a standard digital plane; Reveillès 1991); so these are moved, with `reach` 0.5. A gap beside
/// another one, whose points are taken, needs those of the next plane: up to the whole sum, `reach` 1. Points that were
/// moved already stay. Returns whether any was moved.
bool enterGaps(MovingGrid& grid, double reach);

} // namespace atria
