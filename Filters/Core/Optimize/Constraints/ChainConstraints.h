// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Layer/LayerTopology.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Moves the points of divided layers by chains: the copy leads, and those between it and its wall point go their share
/// of its way. Points of walls stay; the others go where other constraints let them.
class ChainConstraints : public VertexConstraints
{
public:
  /// Shares are those of the way from wall point to copy where points are now.
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
  /// By new point.
  std::vector<double> shares_;
  /// By leader of points in one place, as on the two sides of a sheet, whether a chain stands on one of them.
  std::vector<char> hasChain_;
};

} // namespace atria
