// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/LeafTopology.h"

#include <algorithm>

namespace atria {

namespace {

void sortUnique(std::vector<Index>& values)
{
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

} // namespace

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

std::vector<Index> leavesAbout(Index leaf, std::span<const CutEdge> edges)
{
  std::vector<Index> leaves{leaf};
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
  return leaves;
}

void LeafTopology::analyse(Index leaf, std::span<const CutEdge> edges)
{
  gather(leaf, edges);
  nearCurves.clear();
  if (charts_.size() > 1)
  {
    gatherCurves(leaf, edges);
  }
  UnionFind sets(uses.size());
  links_.clear();
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end)
  {
    for (end = begin + 1; end < uses.size() && uses[end].to == uses[begin].to; ++end)
    {
    }
    look(leaf, begin, end, sets);
  }
  countSheets(sets);
}

void LeafTopology::countSheets(UnionFind& sets)
{
  // A face is at two mesh edges of the vertex, and joins what is there.
  for (std::size_t u = 0; u < uses.size(); ++u)
  {
    for (std::size_t w = 0; w < u; ++w)
    {
      if (uses[u].edge == uses[w].edge && uses[u].chart == uses[w].chart)
      {
        sets.join(static_cast<Index>(u), static_cast<Index>(w));
      }
    }
  }
  sheets_ = 0;
  apart_.clear();
  for (Index u = 0; u < uses.size(); ++u)
  {
    sheets_ += sets.find(u) == u ? 1 : 0;
    for (Index w = 0; w < u; ++w)
    {
      if (uses[u].chart != uses[w].chart && sets.find(u) != sets.find(w))
      {
        apart_.push_back(std::minmax(uses[u].chart, uses[w].chart));
      }
    }
  }
  std::sort(apart_.begin(), apart_.end());
  apart_.erase(std::unique(apart_.begin(), apart_.end()), apart_.end());
}

std::vector<std::vector<Index>> LeafTopology::curves() const
{
  std::vector<std::vector<Index>> endings;
  for (const Link& link : links_)
  {
    endings.push_back(link.ending);
  }
  std::sort(endings.begin(), endings.end());
  endings.erase(std::unique(endings.begin(), endings.end()), endings.end());
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
  charts_.clear();
  for (Index e = 0; e < edges.size(); ++e)
  {
    for (const SurfaceCrossing& cut : edges[e].cuts)
    {
      const Index chart = model.charts[cut.triangle];
      charts_.push_back(chart);
      for (const Index to : edges[e].beside)
      {
        if (to != leaf)
        {
          uses.push_back({to, chart, e});
        }
      }
    }
  }
  sortUnique(charts_);
  std::sort(uses.begin(), uses.end());
}

void LeafTopology::gatherCurves(Index leaf, std::span<const CutEdge> edges)
{
  for (const Index near : leavesAbout(leaf, edges))
  {
    for (const ModelItem piece : octree.items(near))
    {
      if (piece.kind == ModelItem::featureEdge)
      {
        nearCurves.push_back(model.featureEdges[piece.index].curve);
      }
    }
  }
  sortUnique(nearCurves);
}

/// Looks at the mesh edge whose uses are [begin, end).
void LeafTopology::look(Index leaf, std::size_t begin, std::size_t end, UnionFind& sets)
{
  std::vector<Index> ending;
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
  }
  bool pass = false;
  for (std::size_t u = begin + 1; u < end; ++u)
  {
    for (std::size_t w = begin; w < u; ++w)
    {
      if (meet(uses[u].chart, uses[w].chart, ending))
      {
        sets.join(static_cast<Index>(u), static_cast<Index>(w));
        pass = pass || uses[u].chart != uses[w].chart;
      }
    }
  }
  if ((!ending.empty() || pass) && !onOneSide(leaf, uses[begin].to))
  {
    links_.push_back({uses[begin].to, std::move(ending)});
  }
}

/// Whether two charts at a mesh edge, where `ending` end, meet in a curve of the model.
bool LeafTopology::meet(Index a, Index b, const std::vector<Index>& ending) const
{
  return a == b || std::any_of(nearCurves.begin(), nearCurves.end(), [&](Index c) {
           const FeatureCurve& curve = model.curves[c];
           return std::includes(ending.begin(), ending.end(), curve.ending.begin(), curve.ending.end()) &&
                  std::binary_search(curve.charts.begin(), curve.charts.end(), a) &&
                  std::binary_search(curve.charts.begin(), curve.charts.end(), b);
         });
}

/// Whether the mesh edge between two leaves lies in a domain side.
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
