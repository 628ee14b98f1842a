// SPDX-License-Identifier: GPL-3.0-or-later
/// Points of layers whose positions are known before layers are grown.
#pragma once

#include "Support/Types.h"

#include <algorithm>
#include <span>
#include <vector>

namespace atria {

/// Points of a plain mesh that were improved before, and positions of the layer points above them. All lists are empty
/// if there are none.
struct SettledPoints
{
  /// One entry per point: the number of layer points above it; noIndex if it has not been improved.
  std::vector<Index> counts;
  /// One entry per point: the place of the first one in `above`, which lists them from the wall up.
  std::vector<Index> firsts;
  std::vector<Vec3> above;
  /// One entry per point: 1 if it keeps its position, with all points above it.
  std::vector<char> fixed;
  /// One entry per point: 1 if the mesh was cut there from a larger one, so that some of its elements are missing.
  std::vector<char> atCut;
  /// True if layers start as they are above these points; false if they start as one layer of the total height.
  bool areDivided = false;

  bool isEmpty() const { return counts.empty(); }
  bool has(Index point) const { return !isEmpty() && counts[point] != noIndex; }
  bool stays(Index point) const { return !fixed.empty() && fixed[point] != 0; }
  bool keepsLayers(Index point) const { return stays(point) || (areDivided && has(point)); }
  bool isAtCut(Index point) const { return !atCut.empty() && atCut[point] != 0; }
  std::span<const Vec3> aboveOf(Index point) const { return {above.data() + firsts[point], counts[point]}; }

  /// Marks all points as not settled.
  void open(std::size_t points)
  {
    counts.assign(points, noIndex);
    firsts.assign(points, 0);
  }
  void settle(Index point, std::span<const Vec3> places)
  {
    if (has(point) && counts[point] == places.size())
    {
      std::ranges::copy(places, above.begin() + firsts[point]);
      return;
    }
    counts[point] = static_cast<Index>(places.size());
    firsts[point] = static_cast<Index>(above.size());
    above.insert(above.end(), places.begin(), places.end());
  }
};

} // namespace atria
