// SPDX-License-Identifier: GPL-3.0-or-later
/// Repairs a soup: small parts, gaps, contacts, overlaps, winding.
#pragma once

#include "Support/RunContext.h"
#include "Surface/Repair/ClusterCells.h"
#include "Surface/Repair/RepairReport.h"
#include "Surface/Triangles/TriangleSoup.h"

namespace atria {

class Overlaps;

/// Distances in lattice units.
struct SurfaceRepairOptions
{
  std::int64_t weldDistance = 0;
  /// Gaps narrower than this are closed; below 1 none is.
  double gapTolerance = 0.0;
  ClusterOptions clusters;
  /// See SmallPartOptions.
  double smallPartSize = 0.0;
  std::vector<char> keptSurfaces;
  /// Same as AutorefineOptions::overlaps.
  Overlaps* overlaps = nullptr;
};

/// Makes a soup sound: leaves out small parts, closes gaps, cuts triangles where they touch or pass through each other,
/// drops all but one of several overlapping pieces and makes the winding consistent. Afterwards triangles meet in
/// common edges and points only, except in clusters and at the contacts that the report counts. Surfaces and sources of
/// pieces are those of their triangles; points not used are dropped, and the others keep their order. The result does
/// not depend on threads. Throws Aborted on demand.
void repairSurface(TriangleSoup& soup, const GridFrame& frame, const SurfaceRepairOptions& options,
                   SurfaceRepairReport& report, const RunContext& context);

} // namespace atria
