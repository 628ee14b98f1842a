// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Zones/BoundaryGaps.h"

#include <tuple>

namespace atria {

/// An edge of the grid that passes a triangle.
struct PassingEdge
{
  Index point;
  std::uint8_t direction;
  SurfaceCrossing cut;

  std::pair<Index, std::uint8_t> edge() const { return {point, direction}; }
  bool operator<(const PassingEdge& other) const
  {
    return std::tie(point, direction, cut.parameter, cut.triangle, cut.orientation) <
           std::tie(other.point, other.direction, other.cut.parameter, other.cut.triangle, other.cut.orientation);
  }
};

/// Edges of the grid that nothing cuts and that pass a bridge: exact as all crossings are, so that edges round a place
/// agree. `triangle` is what cuts them.
std::vector<PassingEdge> passingEdgesOf(const BridgeTriangle& bridge, Index triangle, const Crossings& crossings,
                                        const GridPlaces& grid);

/// Closes gaps ahead of boundary edges that are no wider than `tolerance` times the octants there: edges of the grid
/// that pass their bridges, and those between the bridges of edges that meet, are cut by the boundary edges' triangles.
/// Both boundary edges of a crack have their bridge. Nothing is done at tolerance 0. The result does not depend on
/// threads.
Crossings closeCracks(Crossings crossings, const BoundaryGaps& gaps, const GridPlaces& grid, double tolerance,
                      const MeshingContext& context);

} // namespace atria
