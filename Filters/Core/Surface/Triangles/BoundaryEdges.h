// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds boundary edges: edges that only one triangle uses, at which a sheet ends.
#pragma once

#include "Support/Angles.h"
#include "Support/Buckets.h"
#include "Surface/Triangles/TriangleSoup.h"

#include <cmath>
#include <functional>

namespace atria {

/// An edge in the direction in which its triangle is wound: from a to b, and on to the third point.
struct BoundaryEdge
{
  Index a;
  Index b;
  Index third;
  Index triangle;

  Index end(unsigned which) const { return which == 0 ? a : b; }
};

/// The boundary edges of a list of triangles, sorted by triangle.
class BoundaryEdges
{
public:
  /// Takes only triangles that `wants` accepts.
  BoundaryEdges(std::span<const std::array<Index, 3>> triangles, std::size_t pointCount, const Executor& executor,
                const std::function<bool(Index)>& wants = nullptr);

  const std::vector<BoundaryEdge>& edges() const { return edges_; }

  struct End
  {
    Index edge;
    unsigned which; ///< 0 at a, 1 at b
  };
  /// Returns the boundary edges of a triangle.
  std::span<const BoundaryEdge> of(Index triangle) const;
  /// Returns the ends of edges at a point, in order, as codes for `endOf`.
  std::span<const Index> at(Index point) const { return ends_.of(point); }
  static End endOf(Index code) { return {code / 2, code % 2}; }
  static Index codeOf(const End& end) { return 2 * end.edge + end.which; }

  struct Link
  {
    Index edge;
    bool forward; ///< from a to b
  };
  /// Edges that follow each other. A run ends at points where not exactly two edges meet; a ring has no end.
  struct Run
  {
    std::vector<Link> links;
    bool isRing = false;
  };
  /// Returns all runs. Each edge is in one run. Runs with ends come first.
  std::vector<Run> runs() const;

private:
  std::vector<BoundaryEdge> edges_;
  /// Per point, 2 * edge + end.
  Buckets ends_;
};

/// Returns the unit vector in the plane of a boundary edge's triangle that leads away from it, square to the edge.
inline Vec3 outwardOf(const BoundaryEdge& edge, std::span<const LatticePoint> points)
{
  const Vec3 along = between(points[edge.a], points[edge.b]).normalized();
  const Vec3 inward = between(points[edge.a], points[edge.third]);
  return (along.dot(inward) * along - inward).normalized();
}

/// True if a way leads ahead: within 45 degrees of where a sheet would go on. The two sides of an opening's corner are
/// that far from being ahead of each other, also those of a gable's.
inline bool isAhead(const Vec3& outward, const Vec3& way) { return way.dot(outward) >= alongCosine * way.norm(); }

/// Returns how far a box reaches from p in a direction.
inline double reachOf(const Box3& box, const Vec3& p, const Vec3& direction)
{
  const Vec3 farthest = (direction.array() > 0.0).select(box.max, box.min);
  return (farthest - p).dot(direction);
}

/// Returns false if no part of a box is ahead of p.
inline bool reachesAhead(const Vec3& outward, const Vec3& p, const Box3& box)
{
  return reachOf(box, p, outward) >= alongCosine * std::sqrt(box.squaredDistance(p));
}

} // namespace atria
