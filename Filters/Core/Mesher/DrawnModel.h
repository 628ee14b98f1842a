// SPDX-License-Identifier: GPL-3.0-or-later
/// What zones are told of the model as it was drawn.
#pragma once

#include "Domain/PlacedModel.h"
#include "Dual/Zones/ZoneEnclosures.h"

namespace atria {

/// Refers to the surface. O(triangles · log triangles).
/// \param kinds  By surface; empty where all are walls.
DrawnModel drawnModel(const TriangleSurface& surface, const SiteOptions& site, const std::vector<SurfaceKind>& kinds,
                      const GridFrame& frame, const RunContext& context);

} // namespace atria
