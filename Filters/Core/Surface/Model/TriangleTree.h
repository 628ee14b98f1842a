// SPDX-License-Identifier: GPL-3.0-or-later
/// Tests rays, boxes and points against all triangles of a model.
#pragma once

#include "Surface/Model/SurfaceModel.h"
#include "Surface/Search/BoxTests.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <tuple>

namespace atria {

/// A tree of bounding boxes over the triangles, in flat arrays: 36 bytes per triangle.
class TriangleTree
{
public:
  explicit TriangleTree(const SurfaceModel& model);

  struct Hit
  {
    double distance = std::numeric_limits<double>::infinity();
    Index triangle = noIndex;
  };

  /// Returns the nearest triangle that the ray from `origin` along the unit vector `direction` meets at a distance in
  /// (nearest, farthest), all in lattice units.
  Hit firstHit(const Vec3& origin, const Vec3& direction, double nearest, double farthest) const;

  /// Returns the triangles whose bounds touch the box, sorted.
  std::vector<Index> touching(const LatticeBox& box) const;

  /// Returns the point of a triangle nearest to p.
  Vec3 nearestOn(Index triangle, const Vec3& p) const;

  /// A point of a triangle, with its squared distance.
  struct Place
  {
    double squaredDistance;
    Index triangle;
    Vec3 at;

    /// Compares by distance, and equal distances by triangle.
    bool isNearerThan(const Place& other) const
    {
      return std::tie(squaredDistance, triangle) < std::tie(other.squaredDistance, other.triangle);
    }
  };

  /// Rule of a search for the nearest place that takes any place. Other rules hide the functions that they restrict.
  struct AnyPlace
  {
    /// Returns false for a box that holds no place to take.
    bool reaches(const Box3&) const { return true; }
    bool wants(Index) const { return true; }
    /// Called for the nearest place of each triangle, if it is nearer than the best one so far.
    bool takes(const Place&) const { return true; }
  };
  template <typename IsWanted> struct AnyPlaceOn : AnyPlace
  {
    IsWanted isWanted;
    explicit AnyPlaceOn(IsWanted w) : isWanted(std::move(w)) {}
    bool wants(Index triangle) const { return isWanted(triangle); }
  };

  /// Returns the place nearest to p of all that the rule takes and that are no farther than `farthest`, in lattice
  /// units. Each triangle has one place: its point nearest to p.
  template <typename Rule> std::optional<Place> nearest(const Vec3& p, double farthest, const Rule& rule) const;

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

template <typename Rule>
std::optional<TriangleTree::Place> TriangleTree::nearest(const Vec3& p, double farthest, const Rule& rule) const
{
  Place best{farthest * farthest, noIndex, p};
  // Nodes with a lower bound of their squared distance; the nearer child is visited first.
  std::vector<std::pair<double, Index>> open;
  const auto add = [&](double distance, Index id) {
    if (distance <= best.squaredDistance && rule.reaches(nodes_[id].box))
    {
      open.emplace_back(distance, id);
    }
  };
  if (!nodes_.empty())
  {
    add(nodes_[0].box.squaredDistance(p), 0);
  }
  while (!open.empty())
  {
    const auto [bound, id] = open.back();
    open.pop_back();
    const Node& node = nodes_[id];
    if (bound > best.squaredDistance)
    {
      continue;
    }
    if (node.upper != noIndex)
    {
      const double lower = nodes_[id + 1].box.squaredDistance(p);
      const double upper = nodes_[node.upper].box.squaredDistance(p);
      add(std::max(lower, upper), lower <= upper ? node.upper : id + 1);
      add(std::min(lower, upper), lower <= upper ? id + 1 : node.upper);
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i)
    {
      const Index t = order_[i];
      if (!rule.wants(t))
      {
        continue;
      }
      const Vec3 q = nearestOn(t, p);
      const Place place{(q - p).squaredNorm(), t, q};
      if (place.isNearerThan(best) && rule.takes(place))
      {
        best = place;
      }
    }
  }
  return best.triangle == noIndex ? std::nullopt : std::optional(best);
}

/// A tree that is built when it is first requested, by any number of threads.
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
