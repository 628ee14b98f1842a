// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Grid/Prism.h"
#include "Surface/Repair/SurfaceRepair.h"
#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Closes a domain that is no box along the grid. Coordinates are along the domain's own axes.
///
/// Cuts triangles at the upright planes of `domain`, drops what is beyond them, and adds the sides, upright sheets with
/// normals outwards from `reach` below to `reach` above the domain. Sides and surfaces share points and edges where
/// they meet. The triangles of a side have the number of names plus that of the side (see Prism.h) as their surface id,
/// which is the tag of bare domain sides; triangles that lie in a side's plane take its place, where several do the one
/// that FacePrecedence says. Points within `tolerance` of a plane are put on it. Returns what surfaces share on sides.
std::vector<SharedArea> cutToSides(TriangleSurface& surface, const PlacedPrism& domain, double reach, double tolerance);

} // namespace atria
