// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Grid/GridFrame.h"

#include <vector>

namespace atria {

/// Tells of points that are added one by one whether there is an earlier one within `distance` lattice units in each
/// coordinate. The points are referred to, and may grow. O(1) on average for each.
class PointWelder
{
public:
  PointWelder(const std::vector<LatticePoint>& points, std::int64_t distance);

  /// Adds the next point. Returns the first one that is kept and within the distance: itself where there is none.
  Index addNext();
  /// Of all points that are not added yet.
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
  /// one has to be searched.
  std::vector<Index> heads;
  std::vector<Index> next;
};

/// For each point the index of the first point that it is one with: itself, or an earlier kept point within `distance`
/// lattice units in each coordinate. O(n) on average.
std::vector<Index> weldPoints(const std::vector<LatticePoint>& points, std::int64_t distance);

} // namespace atria
