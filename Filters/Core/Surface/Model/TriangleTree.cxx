// SPDX-License-Identifier: GPL-3.0-or-later
#include "Surface/Model/TriangleTree.h"

#include "Surface/Search/Distance.h"
#include "Surface/Search/Slabs.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <tuple>

namespace atria {

namespace {

/// Returns the ray's parameter where it enters the box; infinity if it misses the box before `farthest`.
double entry(const Box3& box, const Vec3& origin, const Vec3& direction, double farthest)
{
  const SegmentRange range = clipLine(box.min - origin, box.max - origin, direction, farthest);
  return range.empty() ? std::numeric_limits<double>::infinity() : range.begin;
}

/// Returns the ray's parameter at the triangle (Möller and Trumbore 1997), or infinity. Edges count.
double rayParameter(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c)
{
  constexpr double none = std::numeric_limits<double>::infinity();
  constexpr double rounding = 1e-9;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0.0)
  {
    return none;
  }
  const Vec3 s = origin - a;
  const double u = s.dot(p) / determinant;
  const Vec3 q = s.cross(ab);
  const double v = direction.dot(q) / determinant;
  return u < -rounding || v < -rounding || u + v > 1.0 + rounding ? none : ac.dot(q) / determinant;
}

} // namespace

TriangleTree::TriangleTree(const SurfaceModel& model) : model_(model), order_(model.triangles.size())
{
  std::vector<Entry> entries(order_.size());
  for (Index t = 0; t < order_.size(); ++t)
  {
    const Vec3 sum = toVector(model.corner(t, 0)) + toVector(model.corner(t, 1)) + toVector(model.corner(t, 2));
    entries[t] = {sum / 3.0, t};
  }
  if (!order_.empty())
  {
    nodes_.reserve(order_.size());
    build(entries, 0, static_cast<Index>(order_.size()));
  }
  std::ranges::transform(entries, order_.begin(), &Entry::triangle);
}

Index TriangleTree::build(std::vector<Entry>& entries, Index begin, Index end)
{
  constexpr Index leafSize = 4;
  const auto id = static_cast<Index>(nodes_.size());
  nodes_.push_back({{}, begin, end, noIndex});
  Box3 box;
  if (end - begin <= leafSize)
  {
    for (Index i = begin; i < end; ++i)
    {
      const Box3 own = model_.bounds(entries[i].triangle);
      box.extend(own.min);
      box.extend(own.max);
    }
    nodes_[id].box = box;
    return id;
  }
  Box3 ofCenters;
  for (Index i = begin; i < end; ++i)
  {
    ofCenters.extend(entries[i].center);
  }
  Eigen::Index axis = 0;
  ofCenters.size().maxCoeff(&axis);
  const Index middle = begin + (end - begin) / 2;
  std::nth_element(entries.begin() + begin, entries.begin() + middle, entries.begin() + end,
                   [&](const Entry& l, const Entry& r) {
                     return std::tie(l.center[axis], l.triangle) < std::tie(r.center[axis], r.triangle);
                   });
  const Index lower = build(entries, begin, middle);
  const Index upper = build(entries, middle, end);
  for (const Index child : {lower, upper})
  {
    box.extend(nodes_[child].box.min);
    box.extend(nodes_[child].box.max);
  }
  nodes_[id].box = box;
  nodes_[id].upper = upper;
  return id;
}

TriangleTree::Hit TriangleTree::firstHit(const Vec3& origin, const Vec3& direction, double nearest,
                                         double farthest) const
{
  Hit hit;
  hit.distance = farthest;
  std::vector<Index> open;
  if (!nodes_.empty())
  {
    open.push_back(0);
  }
  while (!open.empty())
  {
    const Index id = open.back();
    open.pop_back();
    const Node& node = nodes_[id];
    if (entry(node.box, origin, direction, hit.distance) > hit.distance)
    {
      continue;
    }
    if (node.upper != noIndex)
    {
      open.push_back(node.upper);
      open.push_back(id + 1);
      continue;
    }
    for (Index i = node.begin; i < node.end; ++i)
    {
      const Index t = order_[i];
      const double distance = rayParameter(origin, direction, toVector(model_.corner(t, 0)),
                                           toVector(model_.corner(t, 1)), toVector(model_.corner(t, 2)));
      if (distance > nearest && std::tie(distance, t) < std::tie(hit.distance, hit.triangle))
      {
        hit = {distance, t};
      }
    }
  }
  return hit.triangle == noIndex ? Hit{} : hit;
}

std::vector<Index> TriangleTree::touching(const LatticeBox& box) const
{
  const Box3 wanted{toVector(box.low), toVector(box.high)};
  std::vector<Index> found;
  std::vector<Index> open(nodes_.empty() ? 0 : 1, 0);
  while (!open.empty())
  {
    const Index id = open.back();
    open.pop_back();
    const Node& node = nodes_[id];
    if (!node.box.touches(wanted))
    {
      continue;
    }
    if (node.upper != noIndex)
    {
      open.push_back(node.upper);
      open.push_back(id + 1);
      continue;
    }
    std::copy_if(order_.begin() + node.begin, order_.begin() + node.end, std::back_inserter(found),
                 [&](Index t) { return model_.bounds(t).touches(wanted); });
  }
  std::sort(found.begin(), found.end());
  return found;
}

Vec3 TriangleTree::nearestOn(Index triangle, const Vec3& p) const
{
  return nearestOnTriangle(p, toVector(model_.corner(triangle, 0)), toVector(model_.corner(triangle, 1)),
                           toVector(model_.corner(triangle, 2)));
}

} // namespace atria
