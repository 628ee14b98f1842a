// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds the bodies of a model as it was drawn, closed and open ones, and the closed ones around a point.
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
  /// Surface of the first triangle.
  Index surface = noIndex;
  std::vector<Index> triangles;
  /// Volume of a closed body, in cubic model units; negative if the fronts are inside.
  double volume = 0.0;
};

/// The bodies of a model: solids that triangles bound as they are wound, and sets of other triangles that share edges.
/// Such a set is closed if each edge has an even number of its triangles. If more than two of these meet in an edge,
/// those of one surface stay together, so that bodies that only touch are separate. Parity decides which body encloses
/// another: it does not depend on how triangles are wound.
class ClosedBodies
{
public:
  /// Takes only triangles that `wants` accepts, and merges points nearer to each other than `weldDistance` (model
  /// units). O(n log n).
  ClosedBodies(const TriangleSurface& surface, const std::function<bool(Index)>& wants, double weldDistance,
               const RunContext& context);

  /// Closed bodies.
  const std::vector<DrawnBody>& bodies() const { return bodies_; }
  const std::vector<DrawnBody>& open() const { return open_; }
  /// Returns the corners of a body's triangle, in model units.
  std::array<Vec3, 3> corners(Index triangle) const;
  Box3 bounds(const DrawnBody& body) const { return {toModel(body.bounds.low), toModel(body.bounds.high)}; }
  /// Returns the closed bodies around a point in model units, the largest first. O(log n) and the triangles above the
  /// point.
  std::vector<Index> around(const Vec3& point) const { return aroundLattice(latticeOf(point)); }
  /// A height, in model units, at which an upright line enters or leaves a closed body.
  struct Crossing
  {
    double height;
    Index body;
  };
  /// Returns where an upright line crosses closed bodies, from below. Crossings above `top` may be missing. O(log n)
  /// and the triangles at the line.
  std::vector<Crossing> crossings(double x, double y, double top) const;
  /// True if a body lies wholly inside another one and touches it nowhere, as far as some of its points tell.
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
  std::vector<Index> bodyOf_; ///< one entry per triangle: its closed body; noIndex for all others
  std::vector<DrawnBody> bodies_;
  std::vector<DrawnBody> open_;
  std::unique_ptr<BoxTree> tree_;
};

} // namespace atria
