// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Grid/Crossings.h"

namespace atria {

/// How often crossings pass a surface along its normal, less those against it.
int senseOf(std::span<const SurfaceCrossing> cuts, Index surface, const SurfaceModel& model);

/// The faces between grid points that lie on permeable surfaces, in the order of the crossed edges. Where an edge
/// crosses several surfaces, its face is on the first one that it does not pass back through.
std::vector<ZoneFace> findZoneFaces(const Crossings& crossings, const SurfaceModel& model);

/// Makes them faces of the elements at the backs of their surfaces, in the order of these and their directions.
void orderZoneFaces(DualMesh& mesh);

} // namespace atria
