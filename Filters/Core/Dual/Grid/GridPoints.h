// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers the grid points of an octree and finds its edges between them.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/Buffer.h"
#include "Support/RunContext.h"

namespace atria {

/// The octree's grid points inside the domain, hanging ones included, and how its edges join them.
/// Points are numbered along the leaves' Morton order, for any number of threads.
struct GridPoints
{
  /// One entry per point: the leaf in each of the eight directions (bits x 1, y 2, z 4). A large leaf fills several.
  Buffer<std::array<Index, 8>> leaves;
  /// One entry per leaf and corner (same bits): the grid point there; noIndex outside the domain.
  Buffer<std::array<Index, 8>> atCorner;

  std::size_t size() const { return leaves.size(); }
};

/// Finds the grid points by two walks over the octree and the faces, edges and points between its octants (Schaefer and
/// Warren 2004). O(n). Throws Error for 2^31 points or more.
GridPoints findGridPoints(const Octree& octree, const RunContext& context);

/// Returns the position of a grid point on the lattice.
LatticePoint positionOf(const Octree& octree, const std::array<Index, 8>& leaves);

/// The octree edge that leaves a grid point in a direction: the finest leaf that has it, and which corner of that leaf
/// the point is. `leaf` is noIndex if there is no edge (a leaf's face or inside is there).
struct GridEdge
{
  Index leaf = noIndex;
  unsigned corner = 0;
};
GridEdge edgeFrom(const Octree& octree, const std::array<Index, 8>& leaves, int direction);

/// True if these are eight leaves of one level. A point between them has all six edges, each of the first leaf there.
bool areOfOneLevel(const Octree& octree, const std::array<Index, 8>& leaves);

} // namespace atria
