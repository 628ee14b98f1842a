// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/MovingGrid.h"

namespace atria {

/// Sends points home whose return leaves less in question, the farthest first. Then moves points one by one where there
/// is most to gain: each point of an octant in question tries the places between the cuts of its edges, a step beyond
/// them, on the other side of a curve where the two sheets that cut an edge meet, and between curves that the octant's
/// vertex cannot both be on. What counts are the surplus cuts of its edges, the surplus sheets and curves of its
/// octants, and a little the way. Of all moves that gain something, those that do not touch the same octants are made,
/// best first, and their neighbours asked again, until nothing is gained. Octants with very many sheets and curves are
/// left as they are.
void searchPlaces(MovingGrid& grid, const RunContext& context);

} // namespace atria
