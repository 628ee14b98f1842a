// SPDX-License-Identifier: GPL-3.0-or-later
/// Describes the model as it was drawn, for the choice of zones.
#pragma once

#include "Domain/PlacedModel.h"
#include "Dual/Zones/ZoneEnclosures.h"

namespace atria {

/// The result refers to the surface. O(triangles · log triangles).
/// \param kinds  One entry per surface; empty if all are walls.
DrawnModel drawnModel(const TriangleSurface& surface, const SiteOptions& site, const std::vector<SurfaceKind>& kinds,
                      const GridFrame& frame, const RunContext& context);

} // namespace atria
