// SPDX-License-Identifier: GPL-3.0-or-later
/// Handles ground that is drawn as a solid.
#pragma once

#include "Domain/ModelBodies.h"

namespace atria {

/// Removes all but the upper side of closed bodies of ground surfaces: faces with faces of the same body above them,
/// and the upright sides between. Walls of pits stay. Returns the surfaces, by id, that lost faces. Heights within
/// `tolerance` are equal.
std::vector<Index> keepUpperSides(TriangleSurface& surface, const SurfaceFlags& isGround, double tolerance);

/// Returns the surface that is the ground although nothing says so, or noIndex. It is a closed slab, at most a tenth as
/// high as it is wide. Nothing else of the model reaches beyond or below it. Its area is at least twice that of the
/// outline of all else.
Index findGroundSlab(const TriangleSurface& surface, const ModelBodies& bodies, double tolerance);

} // namespace atria
