// SPDX-License-Identifier: GPL-3.0-or-later
/// Data for trying a grid point at one place after the other.
#pragma once

#include "Dual/Grid/Crossings.h"
#include "Dual/Leaf/LeafTopology.h"

#include <optional>

namespace atria {

/// A grid point that is tried at several places, and what does not depend on the place: the triangles its edges may
/// meet, and the other edges of the leaves around it. The surplus of a leaf depends on which charts cut its edges, so
/// it is found once for every way in which they do.
struct PointTrial
{
  /// Bounds side by side, as most triangles are left for them.
  struct BoundedTriangle
  {
    LatticeBox bounds;
    Index triangle;
  };

  /// An edge of the point.
  struct Spoke
  {
    /// Its number in the grid; noIndex where it never was cut.
    Index id;
    EdgeSegment segment;
    /// The axis along which it runs with the point undisplaced, or -1.
    int axis;
    bool startsHere;
    bool leavesDomain;
    std::vector<BoundedTriangle> triangles;
    std::vector<SurfaceCrossing> cuts;
    /// The ways in which charts cut it in places so far, and in this one.
    std::vector<std::vector<Index>> ways;
    std::size_t way;
  };

  struct Leaf
  {
    Index id;
    /// A bit for each spoke it has.
    unsigned spokes;
    bool hasOthers;
    std::vector<CutEdge> others;
    /// Surplus of the leaf, by the ways of its spokes.
    std::vector<std::pair<std::uint64_t, int>> found;
  };

  Index point = noIndex;
  LatticePoint undisplaced;
  /// The places for which the spokes' triangles are those that may be met.
  LatticeBox reach;
  std::size_t spokeCount = 0;
  std::array<Spoke, 6> spokes;
  std::size_t leafCount = 0;
  std::array<Leaf, 8> leaves;
  std::vector<Index> near;
  std::vector<Index> triangles;
  std::vector<BoundedTriangle> bounded;

  /// Triangles of a spoke that touch the bounds of its present segment.
  std::vector<Index> touching;

  /// Sets the spoke's segment to what it is with the point there.
  void put(const LatticePoint& place, Spoke& spoke) const;
  /// Lists `touching`.
  void listTouching(const Spoke& spoke);
  /// Sets the spoke's way.
  static void setWay(std::span<const SurfaceCrossing> cuts, const SurfaceModel& model, Spoke& spoke);
  std::uint64_t waysOf(const Leaf& leaf) const;
  std::optional<int> foundIn(const Leaf& leaf) const;
};

} // namespace atria
