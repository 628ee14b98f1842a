// SPDX-License-Identifier: GPL-3.0-or-later
/// Rays, boxes and points against all triangles of a model.
#pragma once

#include "Surface/Model/SurfaceModel.h"
#include "Surface/Search/BoxTests.h"

#include <functional>
#include <mutex>
#include <optional>

namespace atria {

/// A tree of bounding boxes over the triangles, in flat arrays: 36 bytes a triangle.
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

  /// The triangles whose bounds touch the box; sorted.
  std::vector<Index> touching(const LatticeBox& box) const;

  /// The point nearest to p of the triangles that `accepts`; nothing where there is none nearer than `farthest`. All in
  /// lattice units.
  std::optional<Vec3> nearest(const Vec3& p, double farthest, const std::function<bool(Index)>& accepts) const;

private:
  struct Node
  {
    Box3 box;
    Index begin; ///< its triangles are order_[begin, end)
    Index end;
    Index upper; ///< second child; the first follows the node. noIndex in leaves
  };

  struct Entry
  {
    Vec3 center;
    Index triangle;
  };

  /// Sorts the entries by nodes.
  Index build(std::vector<Entry>& entries, Index begin, Index end);

  const SurfaceModel& model_;
  std::vector<Index> order_;
  std::vector<Node> nodes_;
};

/// A tree that is built when it is first asked for, by any number of threads.
class TriangleTreeOnDemand
{
public:
  explicit TriangleTreeOnDemand(const SurfaceModel& model) : model_(model) {}

  const TriangleTree& get() const
  {
    std::call_once(made_, [&] { tree_.emplace(model_); });
    return *tree_;
  }

private:
  const SurfaceModel& model_;
  mutable std::once_flag made_;
  mutable std::optional<TriangleTree> tree_;
};

} // namespace atria
