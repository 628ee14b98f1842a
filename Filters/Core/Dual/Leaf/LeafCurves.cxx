// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Leaf/LeafCurves.h"

#include "Dual/Grid/EdgeProbe.h"
#include "Support/Sorting.h"
#include "Surface/Search/BoxTests.h"

#include <algorithm>

namespace atria {

namespace {

/// Finds the curves of one leaf after the other.
class CurveFinder
{
public:
  CurveFinder(const Octree& tree, const SurfaceModel& surfaces) : octree_(tree), model_(surfaces) {}

  /// Returns the entries of a leaf, sorted.
  const std::vector<LeafCurves::Entry>& find(Index leaf)
  {
    found_.clear();
    for (const ModelItem piece : octree_.items(leaf, ModelItem::featureEdge))
    {
      add(model_.featureEdges[piece.index]);
    }
    if (hasSeveralCharts(leaf))
    {
      addNicks(leaf);
    }
    sortUnique(found_);
    return found_;
  }

private:
  void add(const FeatureEdge& edge)
  {
    for (const Index chart : model_.curves[edge.curve].charts)
    {
      found_.push_back({chart, edge.curve});
    }
  }

  bool hasSeveralCharts(Index leaf) const
  {
    const auto triangles = octree_.items(leaf, ModelItem::triangle);
    return std::ranges::any_of(triangles, [&](ModelItem piece) {
      return model_.charts[piece.index] != model_.charts[triangles.front().index];
    });
  }

  /// Adds the curves that pass close beyond a face or an edge of a leaf.
  void addNicks(Index leaf)
  {
    LatticeBox box{octree_.lowCorner(leaf), octree_.highCorner(leaf)};
    const auto reach = static_cast<std::int64_t>(nickDepth * static_cast<double>(box.high[0] - box.low[0]));
    listBeside(box);
    for (int axis = 0; axis < 3; ++axis)
    {
      box.low[axis] -= reach;
      box.high[axis] += reach;
    }
    for (const Index other : beside_)
    {
      for (const ModelItem piece : octree_.items(other, ModelItem::featureEdge))
      {
        const FeatureEdge& edge = model_.featureEdges[piece.index];
        const SegmentRange range = clipSegment(box, model_.points[edge.a], model_.points[edge.b]);
        if (range.begin < range.end)
        {
          add(edge);
        }
      }
    }
  }

  /// Lists the leaves that share a face or an edge with a box, none of them smaller than half of it.
  void listBeside(const LatticeBox& box)
  {
    beside_.clear();
    const std::int64_t end = octree_.frame().latticeSize(0);
    const std::int64_t quarter = (box.high[0] - box.low[0]) / 4;
    for (int i = 0; i < 64; ++i)
    {
      const std::array<int, 3> at{i % 4, i / 4 % 4, i / 16};
      LatticePoint p{};
      for (int axis = 0; axis < 3; ++axis)
      {
        const std::array places{box.low[axis] - 1, box.low[axis] + quarter, box.high[axis] - quarter, box.high[axis]};
        p[axis] = places[at[axis]];
      }
      const auto beyond = std::ranges::count_if(at, [](int place) { return place == 0 || place == 3; });
      if ((beyond == 1 || beyond == 2) && std::ranges::all_of(p, [&](std::int64_t c) { return c >= 0 && c < end; }))
      {
        beside_.push_back(octree_.leafAt(p));
      }
    }
    sortUnique(beside_);
  }

  const Octree& octree_;
  const SurfaceModel& model_;
  std::vector<LeafCurves::Entry> found_;
  std::vector<Index> beside_;
};

} // namespace

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
    CurveFinder finder(octree, model);
    for (std::size_t leaf = p * grain; leaf < std::min((p + 1) * grain, count); ++leaf)
    {
      const std::vector<Entry>& found = finder.find(static_cast<Index>(leaf));
      if (!found.empty())
      {
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
