// SPDX-License-Identifier: GPL-3.0-or-later
/// Settles which of pieces that lie upon each other stay, and sums up by surface what was dropped.
#pragma once

#include "Surface/Repair/SurfaceRepair.h"
#include "Surface/Triangles/FacePrecedence.h"

#include <map>
#include <optional>

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
  /// Sources of pieces are triangles of `drawn`, which is referred to, as is the frame. `kinds` is as in
  /// FacePrecedence.
  Overlaps(const TriangleSurface& drawn, std::vector<SurfaceKind> kinds, const GridFrame& frame);

  /// Returns the position in `equal` of the piece that stays, and adds the area of the others.
  std::size_t settle(const TriangleSoup& soup, std::span<const Index> equal);

  /// Forgets the areas so far.
  void forget() { byPair_.clear(); }

  /// By the surface that gives and the one that keeps; those of one surface are the same.
  std::vector<Overlap> all() const;
  /// What surfaces that have names share with each other, or have twice.
  std::vector<SharedArea> shared() const;

private:
  void findPrecedence();
  void add(const TriangleSoup& soup, Index kept, Index dropped, bool isWithin);
  bool isOnSide(const TriangleSoup& soup, Index triangle) const;
  bool isSide(Index surface) const { return surface >= drawn_.names.size(); }

  const TriangleSurface& drawn_;
  std::vector<SurfaceKind> kinds_;
  const GridFrame& frame_;
  std::optional<FacePrecedence> precedence_; ///< once different surfaces coincide
  std::vector<Index> sources_;
  std::map<std::pair<Index, Index>, Overlap> byPair_;
};

} // namespace atria
