// SPDX-License-Identifier: GPL-3.0-or-later
/// The octree's position in the model, and the integer lattice on which all decisions are taken.
#pragma once

#include "Grid/GridOptions.h"
#include "Grid/Prism.h"

#include <optional>

namespace atria {

/// A point of the lattice: integers, so that predicates are exact. Differences stay below 2^40.
using LatticePoint = std::array<std::int64_t, 3>;

inline Vec3 toVector(const LatticePoint& p)
{
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// The root cube `[origin, origin + finestSize * 2^depth]^3` that holds the domain. The domain's lower planes pass
/// through the centers of finest octants; so do the upper ones if the domain is a multiple of `finestSize`.
/// `finestSize` is SizeMin, or SizeMin / 2^k if a rule requests finer octants. Features are then k levels above the
/// finest, unless a rule requests otherwise.
///
/// All coordinates are along the axes of `placement`, to which the model was turned.
///
/// Lattice coordinates count from `origin` in units of `finestSize / 2^subBits`.
struct GridFrame
{
  static constexpr int maximumDepth = 20;

  Vec3 origin = Vec3::Zero();
  double finestSize = 1.0;
  int depth = 0;
  int startLevel = 0;
  int midLevel = 0;
  int topLevel = 0;
  /// Level of SizeMin, at which features are that no rule names.
  int featureLevel = 0;
  int subBits = 0;
  Box3 domain;
  LatticePoint domainLow{};
  LatticePoint domainHigh{};
  Placement placement;
  /// The domain proper if it is no box along the grid. Its upright sides are then surfaces, and `domain` is a box of
  /// the grid around it, with the same bottom and top.
  std::optional<PlacedPrism> turnedDomain;

  /// Returns the domain proper, also if it is a box along the grid.
  PlacedPrism prism() const { return turnedDomain.value_or(PlacedBox{placement, domain}); }
  double rootSize() const { return finestSize * static_cast<double>(std::int64_t{1} << depth); }
  double latticeUnit() const { return finestSize / static_cast<double>(std::int64_t{1} << subBits); }
  /// Returns the edge length of an octant of `level`, in lattice units.
  std::int64_t latticeSize(int level) const { return std::int64_t{1} << (depth - level + subBits); }
  double sizeOf(int level) const { return finestSize * static_cast<double>(std::int64_t{1} << (depth - level)); }

  LatticePoint toLattice(const Vec3& p) const;
  Vec3 toModel(const LatticePoint& p) const;
  /// Takes a place between the lattice's points.
  Vec3 toModel(const Vec3& lattice) const { return origin + latticeUnit() * lattice; }
  double toModel(int axis, double lattice) const { return origin[axis] + lattice * latticeUnit(); }

  /// True if the point is strictly inside the domain box.
  bool inDomain(const LatticePoint& p) const;
  /// Returns the domain planes (by Direction, as bits) that pass through the octant [low, high]. A plane on the border
  /// of two octants belongs to the one inside the domain.
  unsigned domainPlanes(const LatticePoint& low, const LatticePoint& high) const;
  /// Returns the model coordinate of a domain plane.
  double planeOf(int direction) const
  {
    return isUpper(direction) ? domain.max[axisOf(direction)] : domain.min[axisOf(direction)];
  }
};

/// Returns the coarsest level at which octants have a valid vertex. Larger octants hold both domain planes of an axis.
int coarsestLevelFor(const GridFrame& frame);

/// Chooses the lattice of a frame whose root and domain are set, so that it holds `extent` too. Throws Error if
/// `extent` reaches too far for it. The octree's keys do not depend on the lattice.
void fitLattice(GridFrame& frame, const Box3& extent);

/// Chooses root, levels and lattice. `extent` must hold every surface point. Throws Error if the domain is empty or
/// thinner than two octants of sizeMin, if sizes are not positive and ordered, if the domain needs more than 20 levels,
/// or if `extent` reaches too far for the lattice.
GridFrame makeGridFrame(const GridOptions& options, const Box3& extent);

} // namespace atria
