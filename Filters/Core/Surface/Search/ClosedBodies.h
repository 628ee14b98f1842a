// SPDX-License-Identifier: GPL-3.0-or-later
/// Closed bodies of a model as it was drawn, and which of them lie around a point.
#pragma once

#include "Surface/Search/BoxTree.h"
#include "Surface/Triangles/TriangleSurface.h"

#include <functional>
#include <memory>

namespace atria {

/// A connected part of a model each of whose edges has an even number of triangles.
struct ClosedBody
{
  LatticeBox bounds;
  /// In cubic units of the lattice; negative where the fronts are inside.
  double volume = 0.0;
  std::vector<Index> triangles;
};

/// The closed bodies of triangles that share edges. Where more than two triangles meet in an edge, those of one surface
/// hold together, so that bodies that only touch are apart. What encloses what is decided by parity: it does not depend
/// on how triangles are wound.
class ClosedBodies
{
public:
  /// Only of triangles that `wants`; points nearer to each other than `weldDistance` (model units) are one.
  /// O(n log n).
  ClosedBodies(const TriangleSurface& surface, const std::function<bool(Index)>& wants, double weldDistance,
               const RunContext& context);

  const std::vector<ClosedBody>& bodies() const { return bodies_; }
  /// The bodies around a point in model units, the largest first. O(log n) and the triangles above the point.
  std::vector<Index> around(const Vec3& point) const { return aroundLattice(latticeOf(point)); }
  /// Whether a body lies wholly inside another one and touches it nowhere, as far as some of its points tell.
  bool isInside(Index inner, Index outer) const;

private:
  LatticePoint latticeOf(const Vec3& point) const;
  std::vector<Index> aroundLattice(const LatticePoint& p) const;
  bool isBelow(const LatticePoint& p, const std::array<Index, 3>& triangle) const;
  void weld(const TriangleSurface& surface, const std::function<bool(Index)>& wants, double weldDistance);
  void findBodies(const RunContext& context);

  Vec3 origin_ = Vec3::Zero();
  double unit_ = 1.0;
  TriangleSoup soup_;
  std::vector<Index> bodyOf_; ///< by triangle; noIndex of those that are of none
  std::vector<ClosedBody> bodies_;
  std::unique_ptr<BoxTree> tree_;
};

} // namespace atria
