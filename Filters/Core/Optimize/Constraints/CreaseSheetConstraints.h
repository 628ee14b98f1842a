// SPDX-License-Identifier: GPL-3.0-or-later
/// Limits where the points of crease sheets may move.
#pragma once

#include "Grid/GridFrame.h"
#include "Layer/LayerTopology.h"
#include "Optimize/Kernel/VertexConstraints.h"
#include "Surface/Model/TriangleTree.h"

namespace atria {

/// Limits the points of crease sheets. Points on walls stay on their charts, or where they are if they have none.
/// Points inside move freely. Both stay on a side of the domain if a sheet ends there. All other points follow other
/// constraints.
class CreaseSheetConstraints : public VertexConstraints
{
public:
  CreaseSheetConstraints(VertexConstraints& others, const LayerMesh& layer, const GridFrame& frame,
                         const SurfaceModel& model, const TriangleTree& tree)
      : others_(others), layer_(layer), frame_(frame), model_(model), tree_(tree)
  {
  }

  void prepare(std::span<const Index> points, const RunContext& context) override;
  bool isMovable(Index point) const override;
  Index leaderOf(Index point) const override { return isOlder(point) ? others_.leaderOf(point) : point; }
  Vec3 place(Index point, const Vec3& p) const override;
  Ways waysFrom(Index point, const Vec3& p, double step) const override;

private:
  bool isOlder(Index point) const { return point < layer_.creaseSheets.firstPoint; }
  const CreaseSheets::Point& at(Index point) const
  {
    return layer_.creaseSheets.points[point - layer_.creaseSheets.firstPoint];
  }
  Vec3 onSides(Index point, const Vec3& p) const;
  Vec3 onChart(Index chart, const Vec3& p) const;

  VertexConstraints& others_;
  const LayerMesh& layer_;
  const GridFrame& frame_;
  const SurfaceModel& model_;
  const TriangleTree& tree_;
};

} // namespace atria
