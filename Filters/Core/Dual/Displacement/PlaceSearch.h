// SPDX-License-Identifier: GPL-3.0-or-later
/// Searches better places for the grid points that are still at unresolved octants.
#pragma once

#include "Dual/Displacement/MovingGrid.h"

namespace atria {

/// Moves points back to their undisplaced places if that leaves less unresolved, the farthest first. Then moves points
/// one by one (PlaceMoves.h): each corner of an unresolved octant tries its candidate places (CandidatePlaces.h). Moves
/// that gain something and touch no octant in common are made, best first. Their neighbors are tried again until
/// nothing is gained. Then it moves several points together (MoveChains.h). Octants with very many sheets and curves
/// stay as they are.
void searchPlaces(MovingGrid& grid, const RunContext& context);

} // namespace atria
