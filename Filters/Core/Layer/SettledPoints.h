// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <algorithm>
#include <span>
#include <vector>

namespace atria {

/// Points of a plain mesh that have been improved before, and places of the points of layers above them. Where there
/// are none, all lists are empty.
struct SettledPoints
{
  /// Per point how many are above it; noIndex for those that have not been improved.
  std::vector<Index> counts;
  /// Per point the place of the first one in `above`, which has them from the wall up.
  std::vector<Index> firsts;
  std::vector<Vec3> above;
  /// Per point, whether it stays where it is, with what is above it.
  std::vector<char> fixed;
  /// Per point, whether it is where the mesh was cut from a larger one: elements there are not what they seem.
  std::vector<char> atCut;
  /// Whether layers begin as they are above these points, and not with one that is as high as all of them.
  bool areDivided = false;

  bool isEmpty() const { return counts.empty(); }
  bool has(Index point) const { return !isEmpty() && counts[point] != noIndex; }
  bool stays(Index point) const { return !fixed.empty() && fixed[point] != 0; }
  bool keepsLayers(Index point) const { return stays(point) || (areDivided && has(point)); }
  bool isAtCut(Index point) const { return !atCut.empty() && atCut[point] != 0; }
  std::span<const Vec3> aboveOf(Index point) const { return {above.data() + firsts[point], counts[point]}; }

  /// So that no point is settled.
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
