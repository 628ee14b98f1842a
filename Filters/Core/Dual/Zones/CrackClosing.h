// SPDX-License-Identifier: GPL-3.0-or-later
/// Closes narrow cracks ahead of boundary edges by cutting the grid edges that pass them.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Zones/BoundaryGaps.h"

#include <functional>
#include <optional>
#include <tuple>
#include <vector>

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

/// Finds edges of the grid that nothing cuts and that pass bridges. Decisions are exact, as those of all crossings, so
/// that edges around a place agree. Bridges near the one before cost little. Not for several threads at once.
class PassageFinder
{
public:
  PassageFinder(const Crossings& crossings, const GridPlaces& grid) : crossings_(crossings), grid_(grid) {}

  /// Returns the edges that pass a bridge, each with the cut that `triangle` makes there. The result is valid until the
  /// next call.
  const std::vector<PassingEdge>& through(const BridgeTriangle& bridge, Index triangle);

private:
  struct UncutEdge
  {
    Index point;
    std::uint8_t direction;
    EdgeSegment segment;
  };
  void gather(const LatticeBox& box);

  const Crossings& crossings_;
  const GridPlaces& grid_;
  std::optional<LatticeBox> gathered_; ///< box around which the edges are
  std::vector<UncutEdge> edges_;
  std::vector<PassingEdge> found_;
};

/// Calls use(edge, finder) for each boundary edge, from several threads. Edges near each other mostly share a finder,
/// and what it has gathered.
void forBoundaryEdges(const BoundaryGaps& gaps, const Crossings& crossings, const GridPlaces& grid,
                      const RunContext& context, const std::function<void(Index, PassageFinder&)>& use);

/// Closes gaps ahead of boundary edges that are no wider than `tolerance` times the octants there: the triangles of
/// boundary edges then cut the grid edges that pass their bridges, or pass between the bridges of edges that meet. Both
/// boundary edges of a crack have their bridge. Does nothing if `tolerance` is 0. The result does not depend on
/// threads.
Crossings closeCracks(Crossings crossings, const BoundaryGaps& gaps, const GridPlaces& grid, double tolerance,
                      const MeshingContext& context);

} // namespace atria
