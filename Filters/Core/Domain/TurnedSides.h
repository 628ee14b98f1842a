// SPDX-License-Identifier: GPL-3.0-or-later
/// Closes a domain that is no box along the grid by sides of its own.
#pragma once

#include "Grid/Prism.h"
#include "Surface/Repair/SurfaceRepair.h"
#include "Surface/Triangles/TriangleSurface.h"

namespace atria {

/// Cuts a model to the domain and adds the domain's sides to it. Coordinates are along the domain's own axes.
///
/// Cuts triangles at the upright planes of `domain` and drops the parts beyond them. The sides are upright sheets with
/// outward normals, from `reach` below to `reach` above the domain. Sides and surfaces share points and edges where
/// they meet. The triangles of a side have the number of names plus that of the side (see Prism.h) as their surface id,
/// which is the tag of bare domain sides. Triangles that lie in a side's plane take its place; FacePrecedence chooses
/// among several. Points within `tolerance` of a plane are put on it. Returns the areas that surfaces share on sides.
std::vector<SharedArea> cutToSides(TriangleSurface& surface, const PlacedPrism& domain, double reach, double tolerance);

} // namespace atria
