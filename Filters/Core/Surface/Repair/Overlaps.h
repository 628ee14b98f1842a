// SPDX-License-Identifier: GPL-3.0-or-later
/// Settles which of pieces that lie upon each other stay, and sums up by surface what was dropped.
#pragma once

#include "Surface/Repair/SurfaceRepair.h"
#include "Surface/Triangles/FacePrecedence.h"

#include <map>

namespace atria {

/// Where two surfaces lie upon each other, or one upon itself.
struct Overlap
{
  SharedArea shared;
  std::size_t pieces = 0; ///< that were dropped
  Vec3 place;             ///< the centroid of the first of them, in lattice units
};

/// Of pieces with the same corners, one stays: that of the surface with precedence.
class Overlaps
{
public:
  /// Precedence is by the triangles of `drawn`, which are its sources. Sides of a turned domain are numbered from
  /// `surfaceCount` on.
  Overlaps(const TriangleSoup& drawn, std::size_t surfaceCount, std::vector<SurfaceKind> kinds, const GridFrame& frame);

  /// Returns the position in `equal` of the piece that stays, and adds the area of the others.
  std::size_t settle(const TriangleSoup& soup, std::span<const Index> equal);

  /// Forgets the areas so far.
  void forget() { byPair_.clear(); }

  /// By the surface that gives and the one that keeps; those of one surface are the same.
  std::vector<Overlap> all() const;
  /// What different surfaces share that have names.
  std::vector<SharedArea> shared() const;

private:
  void add(const TriangleSoup& soup, Index kept, Index dropped, bool isWithin);
  bool isOnSide(const TriangleSoup& soup, Index triangle) const;

  FacePrecedence precedence_;
  std::array<std::array<std::int64_t, 2>, 3> sides_; ///< of the domain, by axis
  double areaUnit_;
  std::vector<Index> sources_;
  std::map<std::pair<Index, Index>, Overlap> byPair_;
};

} // namespace atria
