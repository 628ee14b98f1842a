// SPDX-License-Identifier: GPL-3.0-or-later
/// Limits where the points of a mesh with a layer may move.
#pragma once

#include "Layer/LayerTopology.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Limits the points of a mesh with a layer. New points stay on the domain's sides that their wall points slide on;
/// plain points follow other constraints. Wall points on the two sides of a sheet move together. Settled points stay.
class LayerConstraints : public VertexConstraints
{
public:
  /// `leaders` has one entry per point of the plain mesh: the first point in the same position.
  LayerConstraints(const LayerMesh& layer, const LayerWalls& walls, const LayerOptions& options,
                   const std::vector<Index>& leaders, VertexConstraints& plain);

  void prepare(std::span<const Index> points, const RunContext& context) override;
  bool isMovable(Index point) const override;
  Index leaderOf(Index point) const override { return point < layer_.plainPoints ? leaders_[point] : point; }
  Vec3 place(Index point, const Vec3& p) const override;
  Ways waysFrom(Index point, const Vec3& p, double step) const override;

private:
  SideBits sidesOf(Index wallPoint) const { return sides_[layer_.copies[wallPoint] - layer_.plainPoints]; }

  const LayerMesh& layer_;
  const SettledPoints& settled_;
  const LayerOptions& options_;
  VertexConstraints& plain_;
  const std::vector<Index>& leaders_;
  /// One entry per new point: for a copy, the domain's sides on which it slides; 0 for all others.
  std::vector<SideBits> sides_;
};

} // namespace atria
