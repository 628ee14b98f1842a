// SPDX-License-Identifier: GPL-3.0-or-later
/// From the octree to its dual as it is.
#pragma once

#include "Dual/Displacement/DisplacedGrid.h"
#include "Dual/Zones/BoundaryGaps.h"
#include "Dual/Zones/Labels.h"
#include "Mesher/Diagnostic.h"
#include "Mesher/DualImprover.h"
#include "Mesher/MeshOptions.h"
#include "Support/StageClock.h"

namespace atria {

/// The octree's own grid: its points, and what cuts its edges.
struct OctreeGrid
{
  OctreeGrid(StageClock& clock, const MeshingContext& context);

  /// Finds the crossings with another model, whose octree has the same leaves.
  void findAnew(const MeshingContext& context);

  GridPoints points;
  Crossings crossings;
};

/// The grid that is meshed: the octree's points, what is ahead of boundary edges, and what cuts the edges of the
/// displaced grid.
struct CrossedGrid
{
  /// `port` divides the grid's points.
  CrossedGrid(OctreeGrid grid, const CrossingOptions& options, MeshPort& port, StageClock& clock,
              const MeshingContext& context);

  GridPoints points;
  BoundaryGaps gaps;
  DisplacedGrid displaced; ///< of these points
};

/// New numbers of the grid points that become elements; noIndex for the others.
std::vector<Index> numberElements(const Zones& zones, const std::vector<char>& kept, const RunContext& context);

/// Places the vertices and makes the elements of numbered grid points. Unless the grid is kept, what of it is not
/// needed any more is freed step by step: it is as large as the mesh.
ClassifiedMesh makeElements(CrossedGrid& grid, bool keepGrid, const Zones& zones, const std::vector<Index>& elements,
                            Labels labels, std::vector<Diagnostic>& diagnostics, StageClock& clock,
                            const MeshingContext& context);

} // namespace atria
