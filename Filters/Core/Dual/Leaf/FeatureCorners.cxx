// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Leaf/FeatureCorners.h"

#include "Support/Sorting.h"

#include <algorithm>
#include <cmath>

namespace atria {

namespace {

using Ending = std::vector<Index>;

/// Largest distance from an octant to a corner that its vertex takes, as a part of the octant's size.
constexpr double cornerReach = 0.6;

/// Returns the leaves around a point, out to `cornerReach` times the size of the leaf that holds it.
std::vector<Index> leavesAbout(const Octree& octree, const LatticePoint& p, Index holder)
{
  const std::int64_t end = octree.frame().latticeSize(0);
  const auto step =
      static_cast<std::int64_t>(cornerReach * static_cast<double>(octree.frame().latticeSize(octree.level(holder))));
  std::vector<Index> leaves;
  for (int i = 0; i < 27; ++i)
  {
    const LatticePoint q{p[0] + (i % 3 - 1) * step, p[1] + (i / 3 % 3 - 1) * step, p[2] + (i / 9 - 1) * step};
    if (std::all_of(q.begin(), q.end(), [&](std::int64_t c) { return c > 0 && c <= end; }))
    {
      leaves.push_back(octree.leafAt({q[0] - 1, q[1] - 1, q[2] - 1}));
    }
  }
  sortUnique(leaves);
  return leaves;
}

/// Returns the distance of a point from a leaf over the leaf's size.
double distanceFrom(const Octree& octree, Index leaf, const LatticePoint& p)
{
  const LatticePoint low = octree.lowCorner(leaf);
  const LatticePoint high = octree.highCorner(leaf);
  double outside = 0.0;
  double fromCenter = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto off = static_cast<double>(std::max({low[axis] - p[axis], p[axis] - high[axis], std::int64_t{0}}));
    const double middle = 0.5 * static_cast<double>(low[axis] + high[axis]) - static_cast<double>(p[axis]);
    outside += off * off;
    fromCenter += middle * middle;
  }
  // The distance from the center only settles ties.
  return (std::sqrt(outside) + 1e-3 * std::sqrt(fromCenter)) / static_cast<double>(high[0] - low[0]);
}

/// Returns how ill a vertex suits a corner where these curves meet; negative if it does not suit at all.
double misfit(const ChainVertex& vertex, const std::vector<Ending>& atCorner)
{
  const bool all = std::includes(atCorner.begin(), atCorner.end(), vertex.curves.begin(), vertex.curves.end());
  const bool any = std::any_of(vertex.curves.begin(), vertex.curves.end(), [&](const Ending& ending) {
    return std::binary_search(atCorner.begin(), atCorner.end(), ending);
  });
  if (!any)
  {
    return -1.0;
  }
  const bool branches = atCorner.size() > 1;
  switch (vertex.kind)
  {
    case ChainVertex::knot:
      return all && vertex.curves.size() == atCorner.size() ? 0.0 : (all ? 0.2 : 0.4);
    case ChainVertex::sideEnd:
      return branches ? 0.1 : 0.0;
    default:
      return branches ? 0.6 : 0.0;
  }
}

struct Claim
{
  double cost;
  Index corner;
  Index vertex;
  bool operator<(const Claim& other) const
  {
    return std::tie(cost, corner, vertex) < std::tie(other.cost, other.corner, other.vertex);
  }
};

std::vector<Claim> findClaims(const Octree& octree, const SurfaceModel& model, const std::vector<ChainVertex>& vertices)
{
  const std::vector<std::vector<Ending>> curves = curvesAtCorners(model);
  const std::int64_t end = octree.frame().latticeSize(0);
  std::vector<Claim> claims;
  for (Index c = 0; c < model.corners.size(); ++c)
  {
    const LatticePoint& p = model.points[model.corners[c]];
    if (std::any_of(p.begin(), p.end(), [&](std::int64_t x) { return x <= 0 || x > end; }))
    {
      continue;
    }
    const Index holder = octree.leafAt({p[0] - 1, p[1] - 1, p[2] - 1});
    for (const Index leaf : leavesAbout(octree, p, holder))
    {
      const auto found = std::lower_bound(vertices.begin(), vertices.end(), leaf,
                                          [](const ChainVertex& v, Index l) { return v.leaf < l; });
      if (found == vertices.end() || found->leaf != leaf)
      {
        continue;
      }
      const double ill = misfit(*found, curves[c]);
      const double distance = leaf == holder ? 0.0 : distanceFrom(octree, leaf, p);
      if (ill >= 0.0 && distance <= cornerReach)
      {
        claims.push_back({distance + ill, c, static_cast<Index>(found - vertices.begin())});
      }
    }
  }
  std::sort(claims.begin(), claims.end());
  return claims;
}

} // namespace

std::vector<std::vector<Ending>> curvesAtCorners(const SurfaceModel& model)
{
  std::vector<Index> cornerOf(model.points.size(), noIndex);
  for (Index c = 0; c < model.corners.size(); ++c)
  {
    cornerOf[model.corners[c]] = c;
  }
  std::vector<std::vector<Ending>> curves(model.corners.size());
  for (const FeatureEdge& edge : model.featureEdges)
  {
    for (const Index p : {edge.a, edge.b})
    {
      if (cornerOf[p] != noIndex)
      {
        curves[cornerOf[p]].push_back(model.curves[edge.curve].ending);
      }
    }
  }
  for (auto& list : curves)
  {
    sortUnique(list);
  }
  return curves;
}

std::vector<Index> assignCorners(const Octree& octree, const SurfaceModel& model,
                                 const std::vector<ChainVertex>& vertices)
{
  std::vector<Index> taken(vertices.size(), noIndex);
  std::vector<char> placed(model.corners.size(), 0);
  for (const Claim& claim : findClaims(octree, model, vertices))
  {
    if (taken[claim.vertex] == noIndex && !placed[claim.corner])
    {
      taken[claim.vertex] = model.corners[claim.corner];
      placed[claim.corner] = 1;
    }
  }
  return taken;
}

} // namespace atria
