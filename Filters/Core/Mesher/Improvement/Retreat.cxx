// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/Retreat.h"

#include "Mesher/Improvement/ConcaveElements.h"
#include "Mesher/Improvement/Straightening.h"
#include "Mesher/Improvement/SupportingLayer.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace atria {

namespace {

/// The leaders of an element's corners, or of the points of the wall that these stand above.
std::array<Index, 8> leadersOf(const ImproverState& state, Index element)
{
  std::array<Index, 8> leaders;
  std::ranges::transform(state.layer.mesh.corners[element], leaders.begin(),
                         [&](Index p) { return state.vertexOf[state.layer.wallPointOf(p)]; });
  return leaders;
}

/// Of those that checkMesh would object to.
std::vector<std::array<Index, 8>> leadersOfFailing(ImproverState& state)
{
  std::vector<std::array<Index, 8>> leaders;
  std::ranges::transform(findFailing(state, targetsOfChecks(state.traits)), std::back_inserter(leaders),
                         [&](const ShortCell& cell) { return leadersOf(state, cell.cell); });
  return leaders;
}

/// Marks the leaders of points that are not where they were, or whose copy is not.
std::vector<char> findChanged(const ImproverState& state, const VertexDetachment::Kept& kept)
{
  const LayerMesh& layer = state.layer;
  std::vector<char> changed(state.vertexOf.size(), 0);
  for (Index p = 0; p < changed.size(); ++p)
  {
    const Index copy = layer.copies[p];
    const bool isSame = layer.mesh.points[p] == kept.points[p] && state.excluded[p] == kept.excluded[p] &&
                        (copy == noIndex) == (kept.copies[p] == noIndex) &&
                        (copy == noIndex || layer.mesh.points[copy] == kept.points[kept.copies[p]]);
    changed[state.vertexOf[p]] |= isSame ? 0 : 1;
  }
  return changed;
}

/// Where an attempt changed something. Changes in elements that share a leader are in one place.
class Places
{
public:
  Places(const ImproverState& state, const VertexDetachment::Kept& kept)
      : at_(state.vertexOf.size(), 0), sets_(at_.size()), gain_(at_.size(), 0)
  {
    const std::vector<char> changed = findChanged(state, kept);
    for (Index e = 0; e < state.layer.plainElements; ++e)
    {
      const std::array<Index, 8> leaders = leadersOf(state, e);
      if (std::ranges::any_of(leaders, [&](Index leader) { return changed[leader] != 0; }))
      {
        for (const Index leader : leaders)
        {
          at_[leader] = 1;
          sets_.join(leaders.front(), leader);
        }
      }
    }
  }

  /// Adds to the gain of the place that these elements are in.
  void count(const std::vector<std::array<Index, 8>>& elements, int gain)
  {
    for (const std::array<Index, 8>& leaders : elements)
    {
      const auto found = std::ranges::find_if(leaders, [&](Index leader) { return at_[leader] != 0; });
      if (found != leaders.end())
      {
        gain_[sets_.find(*found)] += gain;
      }
    }
  }

  /// Marks the leaders of places that gained nothing.
  std::vector<char> withoutGain()
  {
    std::vector<char> marked(at_.size(), 0);
    for (Index leader = 0; leader < marked.size(); ++leader)
    {
      marked[leader] = at_[leader] && gain_[sets_.find(leader)] <= 0 ? 1 : 0;
    }
    return marked;
  }

private:
  std::vector<char> at_; ///< by leader
  UnionFind sets_;
  std::vector<int> gain_; ///< by root
};

/// One attempt at all elements that fail.
void tryAnew(const std::vector<ShortCell>& cells, const Retreat& attempt, ImproverState& state,
             VertexDetachment& detachment)
{
  const std::vector<std::array<Index, 8>> before = leadersOfFailing(state);
  const VertexDetachment::Kept kept = detachment.keep();
  state.focus.assign(state.layer.plainPoints, 0);
  detachment.beginAnew(cells, attempt);
  straightenWhereNeeded(state, detachment);
  state.focus.clear();
  supportMore(state, detachment);
  Places places(state, kept);
  places.count(before, 1);
  places.count(leadersOfFailing(state), -1);
  detachment.takeAgain(kept, places.withoutGain());
  if (leadersOfFailing(state).size() > before.size())
  {
    detachment.takeAgain(kept);
  }
}

/// Those that have a leader not tried yet; all of theirs count as tried then.
std::vector<ShortCell> takeUntried(std::vector<ShortCell> cells, const ImproverState& state, std::vector<char>& tried)
{
  std::erase_if(cells, [&](const ShortCell& cell) {
    return std::ranges::all_of(leadersOf(state, cell.cell), [&](Index leader) { return tried[leader] != 0; });
  });
  for (const ShortCell& cell : cells)
  {
    for (const Index leader : leadersOf(state, cell.cell))
    {
      tried[leader] = 1;
    }
  }
  return cells;
}

} // namespace

std::vector<ShortCell> findFailing(ImproverState& state, const QualityTargets& targets)
{
  std::vector<ShortCell> failing = state.findShort(targets, 0.0F);
  if (!state.traits.layered)
  {
    return failing;
  }
  for (const Index cell : findConcaveAtWalls(state.layer.mesh, state.context))
  {
    failing.push_back({cell, 0.0F});
  }
  std::ranges::sort(failing, {}, &ShortCell::cell);
  failing.erase(std::unique(failing.begin(), failing.end(),
                            [](const ShortCell& a, const ShortCell& b) { return a.cell == b.cell; }),
                failing.end());
  return failing;
}

void retreat(ImproverState& state, VertexDetachment& detachment)
{
  QualityTargets targets = targetsOfChecks(state.traits);
  // No place of its points helps an element with too few neighbors.
  targets.leastOfDeterminant = std::numeric_limits<double>::infinity();
  for (const Retreat& attempt : retreats)
  {
    std::vector<char> tried(state.layer.plainPoints, 0);
    for (;;)
    {
      const std::vector<ShortCell> cells = takeUntried(findFailing(state, targets), state, tried);
      if (cells.empty())
      {
        break;
      }
      tryAnew(cells, attempt, state, detachment);
    }
  }
}

} // namespace atria
