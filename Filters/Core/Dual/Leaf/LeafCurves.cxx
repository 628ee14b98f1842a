// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Leaf/LeafCurves.h"

#include "Support/Sorting.h"

#include <algorithm>

namespace atria {

LeafCurves::LeafCurves(const Octree& octree, const SurfaceModel& model, const RunContext& context)
{
  struct Part
  {
    std::vector<Index> leaves;
    std::vector<std::size_t> counts;
    std::vector<Entry> entries;
  };
  constexpr std::size_t grain = 8192;
  const std::size_t count = octree.leafCount();
  std::vector<Part> parts((count + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t p) {
    context.progress.check();
    std::vector<Entry> found;
    for (std::size_t leaf = p * grain; leaf < std::min((p + 1) * grain, count); ++leaf)
    {
      found.clear();
      for (const ModelItem piece : octree.items(static_cast<Index>(leaf), ModelItem::featureEdge))
      {
        const Index curve = model.featureEdges[piece.index].curve;
        for (const Index chart : model.curves[curve].charts)
        {
          found.push_back({chart, curve});
        }
      }
      if (!found.empty())
      {
        sortUnique(found);
        parts[p].leaves.push_back(static_cast<Index>(leaf));
        parts[p].counts.push_back(found.size());
        parts[p].entries.insert(parts[p].entries.end(), found.begin(), found.end());
      }
    }
  });
  offsets.push_back(0);
  for (const Part& part : parts)
  {
    leaves.insert(leaves.end(), part.leaves.begin(), part.leaves.end());
    entries.insert(entries.end(), part.entries.begin(), part.entries.end());
    for (const std::size_t size : part.counts)
    {
      offsets.push_back(offsets.back() + size);
    }
  }
}

std::span<const LeafCurves::Entry> LeafCurves::of(Index leaf) const
{
  const auto found = std::ranges::lower_bound(leaves, leaf);
  if (found == leaves.end() || *found != leaf)
  {
    return {};
  }
  const auto at = static_cast<std::size_t>(found - leaves.begin());
  return std::span(entries).subspan(offsets[at], offsets[at + 1] - offsets[at]);
}

std::span<const LeafCurves::Entry> LeafCurves::atChart(std::span<const Entry> entries, Index chart)
{
  // Clang 14 cannot compile std::ranges::equal_range of this library.
  return {std::ranges::lower_bound(entries, chart, {}, &Entry::chart),
          std::ranges::upper_bound(entries, chart, {}, &Entry::chart)};
}

} // namespace atria
