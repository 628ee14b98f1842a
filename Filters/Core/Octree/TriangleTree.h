// SPDX-License-Identifier: GPL-3.0-or-later
/// Rays against all triangles of a model.
#pragma once

#include "Surface/SurfaceModel.h"

namespace atria {

/// A tree of bounding boxes over the triangles, in flat arrays: 56 bytes a triangle.
class TriangleTree
{
public:
  explicit TriangleTree(const SurfaceModel& model);

  struct Hit
  {
    double distance = std::numeric_limits<double>::infinity();
    Index triangle = noIndex;
  };

  /// The nearest triangle that the ray from `origin` along the unit vector `direction` meets at a distance in (nearest,
  /// farthest), all in lattice units.
  Hit firstHit(const Vec3& origin, const Vec3& direction, double nearest, double farthest) const;

private:
  struct Node
  {
    Box3 box;
    Index begin; ///< its triangles are order_[begin, end)
    Index end;
    Index upper; ///< second child; the first follows the node. noIndex in leaves
  };

  Index build(Index begin, Index end);

  const SurfaceModel& model_;
  std::vector<Vec3> centers_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

} // namespace atria
