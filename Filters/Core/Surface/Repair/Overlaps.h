// SPDX-License-Identifier: GPL-3.0-or-later
/// Chooses which of several overlapping pieces stays, and sums up the dropped areas by surface.
#pragma once

#include "Surface/Repair/SurfaceRepair.h"
#include "Surface/Triangles/FacePrecedence.h"

#include <map>
#include <optional>

namespace atria {

/// The overlap of two surfaces, or of one with itself.
struct Overlap
{
  SharedArea shared;
  std::size_t pieces = 0; ///< number of pieces that were dropped
  Vec3 place;             ///< the centroid of the first of them, in lattice units
};

/// Keeps one of the pieces with the same corners: that of the surface with precedence.
class Overlaps
{
public:
  /// Sources of pieces are triangles of `drawn`. Keeps references to it and to the frame. `kinds` is as in
  /// FacePrecedence.
  Overlaps(const TriangleSurface& drawn, std::vector<SurfaceKind> kinds, const GridFrame& frame);

  /// Returns the position in `equal` of the piece that stays, and adds the area of the others.
  std::size_t settle(const TriangleSoup& soup, std::span<const Index> equal);

  /// Forgets the areas so far.
  void forget() { byPair_.clear(); }

  /// Returns the overlaps, sorted by the surface that gives and the one that keeps. Both are the same for overlaps
  /// within one surface.
  std::vector<Overlap> all() const;
  /// Returns the areas that named surfaces share with each other, or have twice.
  std::vector<SharedArea> shared() const;

private:
  void findPrecedence();
  void add(const TriangleSoup& soup, Index kept, Index dropped, bool isWithin);
  bool isOnSide(const TriangleSoup& soup, Index triangle) const;
  bool isSide(Index surface) const { return surface >= drawn_.names.size(); }

  const TriangleSurface& drawn_;
  std::vector<SurfaceKind> kinds_;
  const GridFrame& frame_;
  std::optional<FacePrecedence> precedence_; ///< set once different surfaces coincide
  std::vector<Index> sources_;
  std::map<std::pair<Index, Index>, Overlap> byPair_;
};

} // namespace atria
