// SPDX-License-Identifier: GPL-3.0-or-later
/// Positions of grid points, displaced ones included, and the edges between them.
#pragma once

#include "Dual/Grid/EdgeProbe.h"
#include "Dual/Grid/GridPoints.h"

#include <unordered_map>

namespace atria {

/// A grid point that is treated as if it were elsewhere.
struct GridTrial
{
  Index point = noIndex;
  LatticePoint place{};
};

/// Positions of the grid points: the octants' corners, except for points that were moved (the displaced grid). The
/// topology is the octree's in any case.
class GridPlaces
{
public:
  GridPlaces(const Octree& tree, const GridPoints& grid) : octree_(tree), points_(grid) {}

  const Octree& octree() const { return octree_; }
  const GridPoints& points() const { return points_; }

  /// Returns the octants' corner that a grid point is.
  LatticePoint undisplaced(Index point) const { return positionOf(octree_, points_.leaves[point]); }
  LatticePoint place(Index point) const
  {
    const auto found = moved_.find(point);
    return found == moved_.end() ? undisplaced(point) : found->second;
  }
  bool isDisplaced(Index point) const { return !moved_.empty() && moved_.contains(point); }

  LatticePoint place(Index point, const GridTrial& trial) const
  {
    return point == trial.point ? trial.place : place(point);
  }
  bool isDisplaced(Index point, const GridTrial& trial) const
  {
    return point == trial.point ? trial.place != undisplaced(point) : isDisplaced(point);
  }
  std::size_t displacedCount() const { return moved_.size(); }
  void move(Index point, const LatticePoint& to) { moved_[point] = to; }
  /// Returns the displaced points, sorted.
  std::vector<Index> displacedPoints() const;
  void undisplace(Index point) { moved_.erase(point); }

  /// The edge that leaves a grid point in a direction.
  struct Edge
  {
    /// `leaf` is noIndex if there is no edge.
    GridEdge at;
    /// The grid point at the other end; noIndex if the edge leaves the domain.
    Index other = noIndex;

    bool exists() const { return at.leaf != noIndex; }
  };
  Edge edge(Index point, int direction) const;
  /// Returns one edge per Direction.
  std::array<Edge, 6> edges(Index point) const;
  bool isDisplaced(Index point, const Edge& edge, const GridTrial& trial = {}) const
  {
    return (!moved_.empty() || trial.point != noIndex) &&
           (isDisplaced(point, trial) || (edge.other != noIndex && isDisplaced(edge.other, trial)));
  }
  /// Returns an edge as a segment, which ends on the domain's side if the edge leads out of the domain.
  EdgeSegment segment(Index point, int direction, const Edge& edge, const GridTrial& trial = {}) const;
  /// Returns the leaves whose triangles can reach a moved edge: all around its ends.
  std::vector<Index> leavesNear(Index point, const Edge& edge) const;

private:
  const Octree& octree_;
  const GridPoints& points_;
  std::unordered_map<Index, LatticePoint> moved_;
};

} // namespace atria
