// SPDX-License-Identifier: GPL-3.0-or-later
/// Displaces grid points so that the octree resolves thin gaps and walls.
#pragma once

#include "Dual/Displacement/ZonesApart.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// A grid some of whose points are displaced, and its crossings.
struct DisplacedGrid
{
  GridPlaces places;
  Crossings crossings;
};

/// Moves grid points, virtually, where the octree is too coarse for the model: where an edge is cut more than once, or
/// an octant holds sheets that do not meet in it. A point of an edge that passes through both sides of a thin wall goes
/// between them, so that the wall has a layer of octants on either side, at no extra level. Points move by up to the
/// size of their smallest octant along each axis. The topology of the grid stays; crossings, zones and vertices are
/// those of the displaced grid.
///
/// Planes of points enter the gaps (GapPlanes.h); what is left is searched point by point (PlaceSearch.h). No move
/// opens a way between zones that the octree's own grid keeps apart: points through which they would meet go back again
/// (ZonesApart.h). `undisplaced` are the crossings of the octree's own grid, `points`. The cost is that of unresolved
/// places, and of a few passes over the cut edges. Places are searched on all threads; the moves are made in the order
/// of points.
DisplacedGrid displaceGrid(const GridPoints& points, Crossings undisplaced, const GridPart& part,
                           const MeshingContext& context);

} // namespace atria
