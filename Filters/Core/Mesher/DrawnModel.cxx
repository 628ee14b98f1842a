// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/DrawnModel.h"

namespace atria {

DrawnModel drawnModel(const TriangleSurface& surface, const SiteOptions& site, const GridFrame& frame)
{
  const double sizeMin = frame.sizeOf(frame.featureLevel);
  return {surface, groundOf(surface, site, sizeMin).isGround, weldRatio * sizeMin};
}

} // namespace atria
