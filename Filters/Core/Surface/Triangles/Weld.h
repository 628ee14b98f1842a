// SPDX-License-Identifier: GPL-3.0-or-later
/// Merges points that are close to each other.
#pragma once

#include "Grid/GridFrame.h"

#include <vector>

namespace atria {

/// Finds, for points that are added one by one, an earlier one within `distance` lattice units in each coordinate.
/// Keeps a reference to the points, which may grow. O(1) on average for each.
class PointWelder
{
public:
  PointWelder(const std::vector<LatticePoint>& points, std::int64_t distance);

  /// Adds the next point. Returns the first kept point within the distance, or the point itself if there is none.
  Index addNext();
  /// Adds all points that are not added yet, and returns one result for each.
  std::vector<Index> addRest();

private:
  LatticePoint binOf(const LatticePoint& p) const { return {p[0] >> shift, p[1] >> shift, p[2] >> shift}; }
  std::size_t slotOf(const LatticePoint& bin) const;
  Index findFrom(Index head, const LatticePoint& p) const;
  Index findBeside(const LatticePoint& bin, const LatticePoint& p) const;
  void reserve(std::size_t count);

  const std::vector<LatticePoint>& points;
  std::int64_t distance;
  int shift;
  std::size_t added = 0;
  /// Kept points by bin, in a hash table with linear probing. Bins are wide against the distance, so that nearly always
  /// only one has to be searched.
  std::vector<Index> heads;
  std::vector<Index> next;
};

/// Returns, for each point, the point it is merged with: an earlier kept point within `distance` lattice units in each
/// coordinate, or itself. O(n) on average.
std::vector<Index> weldPoints(const std::vector<LatticePoint>& points, std::int64_t distance);

} // namespace atria
