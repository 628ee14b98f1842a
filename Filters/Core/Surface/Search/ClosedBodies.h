// SPDX-License-Identifier: GPL-3.0-or-later
/// Bodies of a model as it was drawn, closed and open ones, and which of the closed ones lie around a point.
#pragma once

#include "Surface/Search/BoxTree.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <functional>
#include <memory>

namespace atria {

/// A connected part of a model.
struct DrawnBody
{
  LatticeBox bounds;
  /// Of the first triangle.
  Index surface = noIndex;
  std::vector<Index> triangles;
  /// Of a closed body, in cubic model units; negative where the fronts are inside.
  double volume = 0.0;
};

/// The solids that triangles bound as they are wound, and of the other triangles those that share edges: closed if each
/// edge has an even number of them. Where more than two of these meet in an edge, those of one surface hold together,
/// so that bodies that only touch are apart. What encloses what is decided by parity: it does not depend on how
/// triangles are wound.
class ClosedBodies
{
public:
  /// Only of triangles that `wants`; points nearer to each other than `weldDistance` (model units) are one.
  /// O(n log n).
  ClosedBodies(const TriangleSurface& surface, const std::function<bool(Index)>& wants, double weldDistance,
               const RunContext& context);

  /// The closed ones.
  const std::vector<DrawnBody>& bodies() const { return bodies_; }
  const std::vector<DrawnBody>& open() const { return open_; }
  /// In model units, of a body's triangle.
  std::array<Vec3, 3> corners(Index triangle) const;
  Box3 bounds(const DrawnBody& body) const { return {toModel(body.bounds.low), toModel(body.bounds.high)}; }
  /// The bodies around a point in model units, the largest first. O(log n) and the triangles above the point.
  std::vector<Index> around(const Vec3& point) const { return aroundLattice(latticeOf(point)); }
  /// How long the way up through a place is inside of two closed bodies at once; model units.
  double commonLength(double x, double y, Index one, Index other) const;
  /// Whether a body lies wholly inside another one and touches it nowhere, as far as some of its points tell.
  bool isInside(Index inner, Index outer) const;

private:
  LatticePoint latticeOf(const Vec3& point) const;
  Vec3 toModel(const LatticePoint& p) const { return origin_ + unit_ * toVector(p); }
  std::vector<Index> aroundLattice(const LatticePoint& p) const;
  bool isBelow(const LatticePoint& p, const std::array<Index, 3>& triangle) const;
  void weld(const TriangleSurface& surface, const std::function<bool(Index)>& wants, double weldDistance);
  void findBodies(const RunContext& context);
  void add(Index triangle, DrawnBody& body);
  double volumeOf(const DrawnBody& body) const;

  Vec3 origin_ = Vec3::Zero();
  double unit_ = 1.0;
  TriangleSoup soup_;
  std::vector<Index> bodyOf_; ///< by triangle; noIndex of those that are of none
  std::vector<DrawnBody> bodies_;
  std::vector<DrawnBody> open_;
  std::unique_ptr<BoxTree> tree_;
};

} // namespace atria
