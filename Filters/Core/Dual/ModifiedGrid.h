// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Crossings.h"

namespace atria {

/// Moves grid points, virtually, where the octree is too coarse for the model: where an edge is cut more than once, or
/// an octant holds sheets that do not meet in it. A point of an edge that passes through both sides of a thin wall goes
/// between them, so that the wall has a layer of octants on either side, at no extra level. Points move by up to 0.55
/// of their shortest edge. The topology of the grid stays; crossings, zones and vertices are those of the moved grid.
///
/// A search: each point in question tries the places between the cuts of its edges, and keeps the one with the fewest
/// surplus cuts of its edges and surplus sheets of its octants; its neighbours are asked again, until nothing is
/// gained. No move opens a way between zones that the octree's own grid keeps apart: points through which they would
/// meet go home again. Returns the crossings of the moved grid; `home` are those of the octree's own. Serial, in the
/// order of points; the cost is that of the places in question.
Crossings modifyGrid(GridPlaces& grid, const SurfaceModel& model, Crossings home, const RunContext& context);

} // namespace atria
