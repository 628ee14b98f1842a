// SPDX-License-Identifier: GPL-3.0-or-later
/// Moves the points of divided layers by chains.
#pragma once

#include "Layer/LayerTopology.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Moves the points of divided layers by chains. The copy leads; the points between it and its wall point move by their
/// shares of its displacement. Wall points of chains stay. Copies and all other points follow other constraints.
class ChainConstraints : public VertexConstraints
{
public:
  /// Takes shares from the present positions: how far a point is on the way from its wall point to the copy. `points`
  /// limits all points but those between.
  ChainConstraints(const LayerMesh& layer, VertexConstraints& points);

  void prepare(std::span<const Index> points, const RunContext& context) override { points_.prepare(points, context); }
  bool isMovable(Index point) const override
  {
    return (layer_.isNew(point) || !hasChain_[points_.leaderOf(point)]) && points_.isMovable(leaderOf(point));
  }
  Index leaderOf(Index point) const override
  {
    return layer_.isNew(point) ? layer_.copies[layer_.wallPointOf(point)] : points_.leaderOf(point);
  }
  double shareOf(Index point) const override { return layer_.isNew(point) ? shares_[point - layer_.plainPoints] : 1.0; }
  Vec3 place(Index point, const Vec3& p) const override { return points_.place(point, p); }
  Ways waysFrom(Index point, const Vec3& p, double step) const override { return points_.waysFrom(point, p, step); }

private:
  const LayerMesh& layer_;
  VertexConstraints& points_;
  /// One entry per new point: its share of the copy's displacement.
  std::vector<double> shares_;
  /// One entry per leader of points in one position, as on the two sides of a sheet: 1 if a chain stands on one of
  /// them.
  std::vector<char> hasChain_;
};

} // namespace atria
