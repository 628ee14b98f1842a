// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/DualVertices.h"

#include "Dual/FeatureCorners.h"
#include "Dual/LeafGeometry.h"
#include "Dual/LeafTopology.h"

#include <algorithm>
#include <optional>

namespace atria {

namespace {

/// Which crossed edges each leaf has, sorted by leaf.
std::vector<std::pair<Index, Index>> crossingsByLeaf(const Crossings& crossings)
{
  std::vector<std::pair<Index, Index>> pairs;
  pairs.reserve(4 * crossings.crossedEdges.size());
  for (Index e = 0; e < crossings.crossedEdges.size(); ++e)
  {
    for (const Index leaf : crossings.crossedEdges[e].segment.about)
    {
      pairs.emplace_back(leaf, e);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

using LeafCuts = std::span<const std::pair<Index, Index>>;

/// The cut edges of one leaf.
LeafCuts cutsOf(const std::vector<std::pair<Index, Index>>& byLeaf, Index leaf)
{
  const auto first = std::lower_bound(byLeaf.begin(), byLeaf.end(), std::pair(leaf, Index{0}));
  const auto last = std::lower_bound(first, byLeaf.end(), std::pair(leaf + 1, Index{0}));
  return {first, last};
}

/// What the vertices of a range of leaves are.
struct Part
{
  std::vector<ChainVertex> chain;
};

class VertexPlacer
{
public:
  VertexPlacer(const Octree& tree, const SurfaceModel& surfaces, const Crossings& cuts)
      : crossings(cuts), topology(tree, surfaces), geometry(tree, surfaces)
  {
  }

  /// Places a vertex that is on no curve, or notes that it is on one.
  void placeOrNote(Index vertex, Index leaf, LeafCuts cuts, DualVertices& out, Part& part)
  {
    geometry.enter(leaf);
    if (cuts.empty())
    {
      out.positions[vertex] = geometry.uncutPosition();
      return;
    }
    look(leaf, cuts);
    if (!topology.links().empty())
    {
      part.chain.push_back({vertex, leaf, kindOfLinks(), topology.curves(), {}});
      for (const LeafTopology::Link& link : topology.links())
      {
        part.chain.back().links.push_back(link.to);
      }
      return;
    }
    out.positions[vertex] = geometry.surfacePosition();
    out.compromised[vertex] = topology.sheets() > 1 && geometry.misses(out.positions[vertex]) ? 1 : 0;
  }

  void placeOnChain(ChainVertex& vertex, Index corner, LeafCuts cuts, DualVertices& out)
  {
    geometry.enter(vertex.leaf);
    look(vertex.leaf, cuts);
    Vec3& position = out.positions[vertex.vertex];
    if (corner != noIndex)
    {
      position = geometry.cornerPosition(corner);
    }
    else if (const auto found = geometry.curvePosition(vertex.curves))
    {
      position = *found;
    }
    else
    {
      position = geometry.surfacePosition();
    }
    vertex.isDiverted = corner == noIndex && vertex.kind == ChainVertex::along && geometry.isDiverted();
    const bool lost = corner == noIndex && vertex.kind == ChainVertex::knot;
    out.compromised[vertex.vertex] = (lost || topology.sheets() > 1) && geometry.misses(position) ? 1 : 0;
  }

  /// Puts a vertex whose octant the curve does not pass between its neighbours on the curve.
  void placeBetween(const ChainVertex& vertex, const Vec3& middle, LeafCuts cuts, DualVertices& out)
  {
    geometry.enter(vertex.leaf);
    look(vertex.leaf, cuts);
    const auto found = geometry.nearestCurvePosition(vertex.curves, middle);
    out.positions[vertex.vertex] = found.value_or(out.positions[vertex.vertex]);
  }

private:
  void look(Index leaf, LeafCuts cuts)
  {
    edges.clear();
    for (const auto& [of, e] : cuts)
    {
      const CrossedEdge& edge = crossings.crossedEdges[e];
      edges.push_back(seenFrom(leaf, edge.segment, crossings.of(edge)));
      geometry.addCut(edge.segment, crossings.of(edge));
    }
    topology.analyse(leaf, edges);
    geometry.setCharts(topology.charts());
  }

  ChainVertex::Kind kindOfLinks() const
  {
    if (!topology.isKnot())
    {
      return ChainVertex::along;
    }
    return topology.isEnd() && geometry.isOnSide() ? ChainVertex::sideEnd : ChainVertex::knot;
  }

  const Crossings& crossings;
  LeafTopology topology;
  LeafGeometry geometry;
  std::vector<CutEdge> edges;
};

/// Corners that no vertex took, of those whose curves are in the mesh about them.
std::vector<Index> missedCorners(const SurfaceModel& model, const std::vector<Index>& taken)
{
  std::vector<Index> missed;
  std::vector<Index> sorted = taken;
  std::sort(sorted.begin(), sorted.end());
  std::copy_if(model.corners.begin(), model.corners.end(), std::back_inserter(missed),
               [&](Index corner) { return !std::binary_search(sorted.begin(), sorted.end(), corner); });
  return missed;
}

/// The middle between the two vertices a vertex is linked with.
std::optional<Vec3> middleOfLinks(const ChainVertex& vertex, const std::vector<ChainVertex>& chain,
                                  const std::vector<Vec3>& positions)
{
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const Index leaf : vertex.links)
  {
    const auto found =
        std::lower_bound(chain.begin(), chain.end(), leaf, [](const ChainVertex& v, Index l) { return v.leaf < l; });
    if (found != chain.end() && found->leaf == leaf)
    {
      sum += positions[found->vertex];
      ++count;
    }
  }
  return count == 2 ? std::optional<Vec3>(0.5 * sum) : std::nullopt;
}

} // namespace

DualVertices placeVertices(const Octree& octree, const SurfaceModel& model, const Crossings& crossings,
                           const std::vector<Index>& leaves, const RunContext& context)
{
  const auto byLeaf = crossingsByLeaf(crossings);
  DualVertices vertices;
  vertices.positions.resize(leaves.size());
  vertices.compromised.resize(leaves.size());
  constexpr std::size_t grain = 4096;
  std::vector<Part> parts((leaves.size() + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    context.progress.check();
    VertexPlacer placer(octree, model, crossings);
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, leaves.size()); ++i)
    {
      placer.placeOrNote(static_cast<Index>(i), leaves[i], cutsOf(byLeaf, leaves[i]), vertices, parts[part]);
    }
  });
  std::vector<ChainVertex> chain;
  for (Part& part : parts)
  {
    std::move(part.chain.begin(), part.chain.end(), std::back_inserter(chain));
  }
  const std::vector<Index> corners = assignCorners(octree, model, chain);
  vertices.missedCorners = missedCorners(model, corners);
  context.executor.forRanges(chain.size(), 256, [&](std::size_t begin, std::size_t end) {
    VertexPlacer placer(octree, model, crossings);
    for (std::size_t i = begin; i < end; ++i)
    {
      placer.placeOnChain(chain[i], corners[i], cutsOf(byLeaf, chain[i].leaf), vertices);
    }
  });
  VertexPlacer placer(octree, model, crossings);
  for (const ChainVertex& vertex : chain)
  {
    if (const auto middle = vertex.isDiverted ? middleOfLinks(vertex, chain, vertices.positions) : std::nullopt)
    {
      placer.placeBetween(vertex, *middle, cutsOf(byLeaf, vertex.leaf), vertices);
    }
  }
  return vertices;
}

} // namespace atria
