// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists the feature curves in each leaf by chart.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

#include <span>

namespace atria {

/// The feature curves that pass through each leaf, by the charts that meet there. Curves that pass close beyond a leaf,
/// by at most nickDepth of its size, are among them: where EdgeProbe drops the tip of a crease, the leaf before the
/// edge has the vertex on that crease. A leaf may have thousands of curves if surfaces cross each other many times
/// over; few of them are of any two charts.
class LeafCurves
{
public:
  struct Entry
  {
    Index chart;
    Index curve;
    auto operator<=>(const Entry&) const = default;
  };

  LeafCurves(const Octree& octree, const SurfaceModel& model, const RunContext& context);

  /// Returns the entries of a leaf, sorted.
  std::span<const Entry> of(Index leaf) const;
  /// Returns those of sorted entries that are at `chart`.
  static std::span<const Entry> atChart(std::span<const Entry> entries, Index chart);

private:
  std::vector<Index> leaves; ///< that have any, sorted
  std::vector<std::size_t> offsets;
  std::vector<Entry> entries;
};

} // namespace atria
