// SPDX-License-Identifier: GPL-3.0-or-later
/// Searches better places for the grid points that are still at unresolved octants.
#pragma once

#include "Dual/Displacement/MovingGrid.h"

namespace atria {

/// Sends points home whose return leaves less unresolved, the farthest first. Then moves points one by one where there
/// is most to gain (PlaceMoves.h): each point of an unresolved octant tries the places there are (CandidatePlaces.h).
/// Moves that gain something and touch no octant in common are made, best first. Their neighbors are tried again until
/// nothing is gained. Then it moves several together (MoveChains.h). Octants with very many sheets and curves are left
/// as they are.
void searchPlaces(MovingGrid& grid, const RunContext& context);

} // namespace atria
