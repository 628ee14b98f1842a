// SPDX-License-Identifier: GPL-3.0-or-later
/// Holds triangles on the lattice as they pass from stage to stage of the repair.
#pragma once

#include "Grid/GridFrame.h"
#include "Support/Buckets.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace atria {

struct TriangleSoup
{
  std::vector<LatticePoint> points;
  std::vector<std::array<Index, 3>> triangles;
  /// Per triangle: the surface it belongs to.
  std::vector<Index> surfaceIds;
  /// Per triangle: the original triangle that it is or is a piece of; ascending.
  std::vector<Index> sources;

  const LatticePoint& corner(Index triangle, int i) const { return points[triangles[triangle][i]]; }

  void add(const std::array<Index, 3>& triangle, Index surfaceId, Index source)
  {
    triangles.push_back(triangle);
    surfaceIds.push_back(surfaceId);
    sources.push_back(source);
  }
};

/// An edge by its points, the lower index first.
using EdgeKey = std::pair<Index, Index>;
inline EdgeKey edgeKey(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }
inline EdgeKey edgeKey(const std::array<Index, 3>& triangle, int i)
{
  return edgeKey(triangle[i], triangle[(i + 1) % 3]);
}

inline bool contains(const std::array<Index, 3>& triangle, Index point)
{
  return triangle[0] == point || triangle[1] == point || triangle[2] == point;
}

inline bool hasRepeatedPoint(const std::array<Index, 3>& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Returns the vector from p to q; differences are exact in double.
inline Vec3 between(const LatticePoint& p, const LatticePoint& q)
{
  return toVector({q[0] - p[0], q[1] - p[1], q[2] - p[2]});
}

/// Returns the triangles at each point, in order.
Buckets trianglesAtPoints(const TriangleSoup& soup);

/// One use of an edge by a triangle; `forward` if the triangle runs from the lower point to the higher.
struct SoupEdgeUse
{
  EdgeKey edge;
  Index triangle;
  bool forward;
};

/// Returns all uses, sorted by edge and then by triangle. O(n), except for points at which many edges meet.
std::vector<SoupEdgeUse> sortedEdgeUses(std::span<const std::array<Index, 3>> triangles, std::size_t pointCount,
                                        const Executor& executor);
std::vector<SoupEdgeUse> sortedEdgeUses(const TriangleSoup& soup, const Executor& executor);

} // namespace atria
