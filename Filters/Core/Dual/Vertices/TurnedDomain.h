// SPDX-License-Identifier: GPL-3.0-or-later
/// Fits the mesh to a domain that is no box along the grid.
#pragma once

#include "Dual/Zones/Zones.h"

#include <span>

namespace atria {

/// Marks faces of turned sides as sides of the domain, as faces on the planes of a box are.
Crossings markTurnedSides(Crossings crossings, std::size_t surfaceCount);

/// Returns one entry per zone: how far the point farthest from the turned sides is beyond them, negative inside. The
/// sides separate zones, so each lies wholly inside or beyond. Empty if the domain is not turned.
std::vector<double> farthestFromSides(const Zones& zones, const GridPlaces& grid, const GridPart& part);

/// Puts the vertices where faces of two turned sides meet on the domain's upright edges. Without this the mesh would
/// cut an edge off in octants none of whose corners is inside the domain. O(n log n) in boundary faces.
void sharpenTurnedEdges(DualMesh& mesh, const GridFrame& frame, std::size_t surfaceCount);

/// Returns for each vertex the turned sides on which it lies and has faces. Empty if the frame has no turned sides.
std::vector<SideBits> turnedSidesOf(const DualMesh& mesh, const GridFrame& frame, std::size_t surfaceCount);

/// Returns the place nearest to `position` on `sides` and within the domain's other sides.
Vec3 onTurnedSides(const Vec3& position, SideBits sides, const GridFrame& frame);

/// Returns the outward normals of the domain's sides by number, along the grid's axes; 0 for sides it does not have.
std::vector<Vec3> sideNormalsOf(const GridFrame& frame);

/// Moves vertices that follow a curve or corner of the model beyond the sides of a turned domain back onto the sides.
void keepWithinSides(std::span<Vec3> positions, const GridFrame& frame);

} // namespace atria
