// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists the faces of elements that lie on permeable surfaces.
#pragma once

#include "Dual/Grid/Crossings.h"

namespace atria {

/// Returns how many crossings pass a surface along its normal, minus those against it.
int senseOf(std::span<const SurfaceCrossing> cuts, Index surface, const SurfaceModel& model);

/// Returns the faces between grid points that lie on permeable surfaces, in the order of the crossed edges. If an edge
/// crosses several surfaces, its face is on the first one that it does not pass back through.
std::vector<ZoneFace> findZoneFaces(const Crossings& crossings, const SurfaceModel& model);

/// Makes zone faces those of the elements at the backs of their surfaces, sorted by element and direction.
void orderZoneFaces(DualMesh& mesh);

} // namespace atria
