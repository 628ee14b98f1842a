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
  /// A triangle and its bounds, which rule out most triangles.
  struct BoundedTriangle
  {
    LatticeBox bounds;
    Index triangle;
  };

  /// An edge of the point.
  struct Spoke
  {
    /// Its number in the grid; noIndex if it was never cut.
    Index id;
    EdgeSegment segment;
    /// The axis along which it runs with the point undisplaced, or -1.
    int axis;
    bool startsHere;
    bool leavesDomain;
    std::vector<BoundedTriangle> triangles;
    std::vector<SurfaceCrossing> cuts;
    /// Lists of the charts that cut it at places so far, and the number of the list for this place.
    std::vector<std::vector<Index>> ways;
    std::size_t way;
  };

  struct Leaf
  {
    Index id;
    /// Bits of the spokes that it has.
    unsigned spokes;
    bool hasOthers;
    std::vector<CutEdge> others;
    /// Surplus of the leaf, by the ways of its spokes.
    std::vector<std::pair<std::uint64_t, int>> found;
  };

  Index point = noIndex;
  LatticePoint undisplaced;
  /// Places for which the spokes have all triangles that they may meet.
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

  /// Sets the spoke's segment as it is with the point at `place`.
  void put(const LatticePoint& place, Spoke& spoke) const;
  /// Sets `touching`.
  void listTouching(const Spoke& spoke);
  /// Sets the spoke's way, by the charts of its cuts.
  static void setWay(std::span<const SurfaceCrossing> cuts, const SurfaceModel& model, Spoke& spoke);
  std::uint64_t waysOf(const Leaf& leaf) const;
  std::optional<int> foundIn(const Leaf& leaf) const;
};

} // namespace atria
