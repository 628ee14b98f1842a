// SPDX-License-Identifier: GPL-3.0-or-later
/// Ground that is drawn as a solid.
#pragma once

#include "Domain/ModelBodies.h"

namespace atria {

/// Takes out, of closed bodies among the surfaces that are ground, all but the upper side: what has faces of the same
/// body above it, and the upright sides between. Walls of pits stay. Returns the surfaces, by id, that lost faces.
/// Heights within `tolerance` are equal.
std::vector<Index> keepUpperSides(TriangleSurface& surface, const SurfaceFlags& isGround, double tolerance);

/// The surface that is the ground though nothing says so: a closed slab, at most a tenth as high as it is wide, that
/// nothing else of the model reaches beyond or below, and with an area at least twice that of the outline of all else.
/// noIndex without one.
Index findGroundSlab(const TriangleSurface& surface, const ModelBodies& bodies, double tolerance);

} // namespace atria
