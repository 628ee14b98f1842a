// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/DrawnModel.h"

namespace atria {

DrawnModel drawnModel(const TriangleSurface& surface, const SiteOptions& site, const std::vector<SurfaceKind>& kinds,
                      const GridFrame& frame, const RunContext& context)
{
  const double sizeMin = frame.sizeOf(frame.featureLevel);
  const auto isWall = [&](Index triangle) {
    const Index of = surface.surfaceIds[triangle];
    return of >= kinds.size() || kinds[of] == SurfaceKind::wall;
  };
  return {surface, groundOf(surface, site, sizeMin).isGround,
          ClosedBodies(surface, isWall, weldRatio * sizeMin, context)};
}

} // namespace atria
