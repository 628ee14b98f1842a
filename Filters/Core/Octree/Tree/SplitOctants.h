// SPDX-License-Identifier: GPL-3.0-or-later
/// Splits octants beside finer ones, so that eight cells meet at each point of the grid.
#pragma once

#include "Grid/LatticeBox.h"
#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"

namespace atria {

/// A cell of the grid: eight times the number of a leaf, plus the part of the leaf. Part 0 of a leaf that is not split
/// is all of it.
using SplitCell = std::uint64_t;
inline Index leafOf(SplitCell cell) { return static_cast<Index>(cell >> 3); }
inline unsigned partOf(SplitCell cell) { return static_cast<unsigned>(cell & 7); }

/// The dual of a grid has hexahedra only if the grid is an arrangement of surfaces of which three cross at each point.
/// In a region of fine octants, planes come in pairs, one through each of two sibling octants. So the two of a pair can
/// be closed to one surface, a slab, by a cap beyond the region. Caps of slabs along x, y and z lie 1/8, 1/4 and 3/8 of
/// a coarse octant beyond it, so that no two coincide. The parts of an octant are the sets of slabs in which places of
/// it are. See docs/algorithm.md.
class SplitOctants
{
public:
  /// `octree` must be balanced in families (see balance()) and outlive the object. O(n log n).
  SplitOctants(const Octree& octree, const RunContext& context);

  bool isSplit(Index leaf) const { return finer_[leaf] != 0; }
  /// Returns the cell of a leaf that is at a point of the leaf, on the point's side `direction`: bits x 1, y 2, z 4.
  /// The point must be a point of the grid or of pointsOf().
  SplitCell cellAt(Index leaf, const LatticePoint& point, unsigned direction) const;
  /// Returns the places in and on a split leaf where surfaces meet, except for points of the octree's grid.
  std::vector<LatticePoint> pointsOf(Index leaf) const;
  /// Returns the bounds of a cell.
  LatticeBox boundsOf(SplitCell cell) const;
  /// Returns where the vertex of a cell starts, in lattice units: where it is best beside a plane border of sizes, else
  /// at the cell's center of mass.
  Vec3 centerOf(SplitCell cell) const;

private:
  unsigned finerAround(Index leaf) const;
  LatticePoint outerCorner(Index leaf) const;
  LatticePoint placeOf(Index leaf, const std::array<int, 3>& local) const;

  const Octree& octree_;
  /// One entry per leaf: bits 1 to 7 are set for octants beyond its outer corner that are refined, if any splits it.
  Buffer<std::uint8_t> finer_;
};

/// Returns the number of points inside the domain where surfaces meet, except for points of the octree's grid, in the
/// octree that sets make. They must be balanced in families. O(n log n).
std::size_t countSplitPoints(const RefinedSets& refined, const GridFrame& frame, const RunContext& context);

} // namespace atria
