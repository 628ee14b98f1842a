// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Layer/LayerTopology.h"
#include "Optimize/Kernel/VertexConstraints.h"

namespace atria {

/// Where the points of a mesh with a layer may go: copies keep to the domain's sides their wall points are on, the
/// others go where other constraints let them. Wall points on the two sides of a sheet stay together. Layers whose
/// height was asked for keep it: their points stay unless they are let go.
class LayerConstraints : public VertexConstraints
{
public:
  /// `leaders` gives for each point of the plain mesh the first of those in its place; leaders of which `letGo` is set
  /// may move in layers of an asked height, too.
  LayerConstraints(const LayerMesh& layer, const LayerWalls& walls, const LayerOptions& options,
                   const std::vector<Index>& leaders, const std::vector<char>& letGo, VertexConstraints& plain);

  void prepare(std::span<const Index> points, const RunContext& context) override;
  bool isMovable(Index point) const override;
  Index leaderOf(Index point) const override { return point < layer_.plainPoints ? leaders_[point] : point; }
  Vec3 place(Index point, const Vec3& p) const override;
  Ways waysFrom(Index point, const Vec3& p, double step) const override;

private:
  void pin(const std::vector<char>& letGo);
  bool isPinned(Index plainPoint) const { return !pinned_.empty() && pinned_[leaders_[plainPoint]] != 0; }
  SideBits sidesOf(Index wallPoint) const { return sides_[layer_.copies[wallPoint] - layer_.plainPoints]; }

  const LayerMesh& layer_;
  const SettledPoints& settled_;
  const LayerOptions& options_;
  VertexConstraints& plain_;
  const std::vector<Index>& leaders_;
  /// Per leader, whether layers at its points have a height of their own; empty where none have.
  std::vector<char> pinned_;
  /// The domain sides that a point with copies slides on, in the place of its copy among the new
  /// points.
  std::vector<SideBits> sides_;
};

} // namespace atria
