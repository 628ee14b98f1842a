// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Leaf/LeafTopology.h"

#include "Support/Sorting.h"

#include <algorithm>

namespace atria {

CutEdge seenFrom(Index leaf, const EdgeSegment& edge, std::span<const SurfaceCrossing> cuts)
{
  CutEdge seen{{leaf, leaf}, cuts};
  const auto at = static_cast<std::size_t>(std::find(edge.about.begin(), edge.about.end(), leaf) - edge.about.begin());
  for (std::size_t i = 1; i < 4; ++i)
  {
    const Index after = edge.about[(at + i) % 4];
    const Index before = edge.about[(at + 4 - i) % 4];
    seen.beside[1] = seen.beside[1] == leaf ? after : seen.beside[1];
    seen.beside[0] = seen.beside[0] == leaf ? before : seen.beside[0];
  }
  return seen;
}

void listLeavesAbout(Index leaf, std::span<const CutEdge> edges, std::vector<Index>& leaves)
{
  leaves.assign(1, leaf);
  for (const CutEdge& edge : edges)
  {
    for (const Index near : edge.beside)
    {
      if (std::find(leaves.begin(), leaves.end(), near) == leaves.end())
      {
        leaves.push_back(near);
      }
    }
  }
}

void LeafTopology::analyze(Index leaf, std::span<const CutEdge> edges)
{
  gather(leaf, edges);
  nearCurves.clear();
  if (charts_.size() > 1)
  {
    gatherCurves(leaf, edges);
  }
  sets.reset(uses.size());
  links_.clear();
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
  {
    for (end = begin + 1; end < uses.size() && uses[end].to == uses[begin].to; ++end)
    {
    }
    look(leaf, begin, end);
  }
  countSheets();
}

void LeafTopology::countSheets()
{
  // A face is at two mesh edges of the vertex, and joins what is there.
  firstOfFace.assign(chartsOfFaces.size(), noIndex);
  for (Index u = 0; u < uses.size(); ++u)
  {
    Index& first = firstOfFace[uses[u].face];
    first = first == noIndex ? u : first;
    sets.join(first, u);
  }
  sheets_ = 0;
  parts.clear();
  for (Index u = 0; u < uses.size(); ++u)
  {
    const Index sheet = sets.find(u);
    sheets_ += sheet == u ? 1 : 0;
    if (parts.empty() || parts.back() != std::pair(uses[u].chart, sheet))
    {
      parts.emplace_back(uses[u].chart, sheet);
    }
  }
  sortUnique(parts);
  apart_.clear();
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    for (std::size_t k = 0; k < i; ++k)
    {
      if (parts[i].first != parts[k].first && parts[i].second != parts[k].second)
      {
        apart_.emplace_back(parts[k].first, parts[i].first);
      }
    }
  }
  sortUnique(apart_);
}

std::vector<std::vector<Index>> LeafTopology::curves() const
{
  std::vector<std::vector<Index>> endings;
  for (const Link& link : links_)
  {
    endings.push_back(link.ending);
  }
  sortUnique(endings);
  return endings;
}

bool LeafTopology::isKnot() const
{
  return !links_.empty() && (links_.size() != 2 || std::any_of(links_.begin(), links_.end(), [&](const Link& link) {
                               return link.ending != links_[0].ending;
                             }));
}

void LeafTopology::gather(Index leaf, std::span<const CutEdge> edges)
{
  uses.clear();
  chartsOfFaces.clear();
  for (const CutEdge& edge : edges)
  {
    const auto first = static_cast<std::ptrdiff_t>(chartsOfFaces.size());
    for (const SurfaceCrossing& cut : edge.cuts)
    {
      const Index chart = model.charts[cut.triangle];
      auto face = std::find(chartsOfFaces.begin() + first, chartsOfFaces.end(), chart);
      if (face == chartsOfFaces.end())
      {
        face = chartsOfFaces.insert(face, chart);
      }
      for (const Index to : edge.beside)
      {
        if (to != leaf)
        {
          uses.push_back({to, chart, static_cast<Index>(face - chartsOfFaces.begin())});
        }
      }
    }
  }
  charts_ = chartsOfFaces;
  sortUnique(charts_);
  std::sort(uses.begin(), uses.end());
}

/// Gathers the curves in which two of the charts meet.
void LeafTopology::gatherCurves(Index leaf, std::span<const CutEdge> edges)
{
  meeting.clear();
  listLeavesAbout(leaf, edges, nearLeaves);
  for (const Index near : nearLeaves)
  {
    const std::span<const LeafCurves::Entry> all = leafCurves.of(near);
    for (const Index chart : charts_)
    {
      for (const LeafCurves::Entry& entry : LeafCurves::atChart(all, chart))
      {
        meeting.emplace_back(entry.curve, chart);
      }
    }
  }
  sortUnique(meeting);
  for (std::size_t i = 1; i < meeting.size(); ++i)
  {
    const Index curve = meeting[i].first;
    if (curve == meeting[i - 1].first && (nearCurves.empty() || nearCurves.back() != curve))
    {
      nearCurves.push_back(curve);
    }
  }
}

/// Looks at the mesh edge whose uses are [begin, end), which are sorted by charts.
void LeafTopology::look(Index leaf, std::size_t begin, std::size_t end)
{
  ending.clear();
  firstOfChart.clear();
  for (std::size_t u = begin; u < end; ++u)
  {
    if (!ending.empty() && ending.back() == uses[u].chart)
    {
      ending.pop_back();
    }
    else
    {
      ending.push_back(uses[u].chart);
    }
    if (u == begin || uses[u].chart != uses[u - 1].chart)
    {
      firstOfChart.push_back(static_cast<Index>(u));
    }
    sets.join(firstOfChart.back(), static_cast<Index>(u));
  }
  const bool pass = joinMeeting();
  if ((!ending.empty() || pass) && !onOneSide(leaf, uses[begin].to))
  {
    links_.push_back({uses[begin].to, ending});
  }
}

/// Joins the charts of `firstOfChart` that meet in a curve of the model, at the mesh edge where `ending` end. Returns
/// true if there are any.
bool LeafTopology::joinMeeting()
{
  bool any = false;
  for (const Index c : nearCurves)
  {
    const FeatureCurve& curve = model.curves[c];
    if (firstOfChart.size() < 2 || !std::ranges::includes(ending, curve.ending))
    {
      continue;
    }
    Index first = noIndex;
    for (const Index u : firstOfChart)
    {
      if (std::ranges::binary_search(curve.charts, uses[u].chart))
      {
        any = any || first != noIndex;
        first = first == noIndex ? u : first;
        sets.join(first, u);
      }
    }
  }
  return any;
}

/// True if the mesh edge between two leaves lies in a domain side.
bool LeafTopology::onOneSide(Index a, Index b) const
{
  const GridFrame& frame = octree.frame();
  const LatticePoint lowA = octree.lowCorner(a);
  const LatticePoint highA = octree.highCorner(a);
  const LatticePoint lowB = octree.lowCorner(b);
  const LatticePoint highB = octree.highCorner(b);
  unsigned shared = frame.domainPlanes(lowA, highA) & frame.domainPlanes(lowB, highB);
  for (int axis = 0; axis < 3; ++axis)
  {
    if (highA[axis] == lowB[axis] || highB[axis] == lowA[axis])
    {
      shared &= ~(3u << (2 * axis));
    }
  }
  return shared != 0;
}

} // namespace atria
