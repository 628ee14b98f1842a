// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes the dual of an octree, not yet improved.
#pragma once

#include "Dual/Displacement/DisplacedGrid.h"
#include "Dual/Zones/BoundaryGaps.h"
#include "Dual/Zones/Labels.h"
#include "Mesher/Diagnostic.h"
#include "Mesher/DualImprover.h"
#include "Mesher/MeshOptions.h"
#include "Support/StageClock.h"

namespace atria {

/// The octree's own grid: its points, and the cuts of its edges.
struct OctreeGrid
{
  OctreeGrid(StageClock& clock, const MeshingContext& context);

  /// Finds the crossings with another model, whose octree has the same leaves.
  void findAnew(const MeshingContext& context);

  GridPoints points;
  Crossings crossings;
};

/// The grid that is meshed: the octree's points, the gaps ahead of boundary edges, and the cuts of the displaced grid's
/// edges.
struct CrossedGrid
{
  /// `port` divides the grid's points.
  CrossedGrid(OctreeGrid grid, const CrossingOptions& options, MeshPort& port, StageClock& clock,
              const MeshingContext& context);

  GridPoints points;
  BoundaryGaps gaps;
  DisplacedGrid displaced; ///< refers to `points`
};

/// Returns new numbers for the grid points that become elements; noIndex for the others.
std::vector<Index> numberElements(const Zones& zones, const std::vector<char>& kept, const RunContext& context);

/// Places the vertices and makes the elements of numbered grid points, with `hexahedra` no others. Unless `keepGrid`,
/// frees the parts of the grid as soon as they are not needed: it is as large as the mesh.
ClassifiedMesh makeElements(CrossedGrid& grid, bool keepGrid, bool hexahedra, const Zones& zones,
                            const std::vector<Index>& elements, Labels labels, std::vector<Diagnostic>& diagnostics,
                            StageClock& clock, const MeshingContext& context);

} // namespace atria
