// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Vertices/DualVertices.h"

#include "Dual/Leaf/FeatureCorners.h"
#include "Dual/Leaf/LeafGeometry.h"
#include "Dual/Leaf/LeafTopology.h"
#include "Octree/Tree/GeometryLists.h"

#include <algorithm>
#include <map>
#include <optional>

namespace atria {

namespace {

using LeafCuts = std::span<const Index>;

/// Classification of the vertices of a range of leaves.
struct Part
{
  std::vector<ChainVertex> chain;
  /// Charts of vertices on surfaces.
  std::vector<std::pair<Index, Index>> charts;
};

class VertexPlacer
{
public:
  VertexPlacer(const Octree& tree, const SurfaceModel& surfaces, const LeafCurves& curves, const Crossings& cuts)
      : crossings(cuts), topology(tree, surfaces, curves), geometry(tree, surfaces)
  {
  }

  /// Places a vertex that is on no curve, or notes that it is on one.
  void placeOrNote(Index vertex, Index leaf, LeafCuts cuts, DualVertices& out, Part& part)
  {
    // Most vertices are in the open, and free as all are at first.
    if (const auto center = cuts.empty() ? geometry.centerOffSides(leaf) : std::nullopt)
    {
      out.positions[vertex] = *center;
      return;
    }
    geometry.enter(leaf);
    if (cuts.empty())
    {
      const std::optional<Vec3> onSide = geometry.sidePosition();
      out.positions[vertex] = onSide.value_or(geometry.center());
      out.classification.classes[vertex] = onSide ? VertexClass::fixed : VertexClass::free;
      return;
    }
    look(leaf, cuts);
    if (!topology.links().empty())
    {
      part.chain.push_back({vertex, leaf, kindOfLinks(), topology.curves(), {}, topology.charts()});
      for (const LeafTopology::Link& link : topology.links())
      {
        part.chain.back().links.push_back(link.to);
      }
      return;
    }
    out.positions[vertex] = geometry.surfacePosition();
    out.compromised[vertex] = topology.sheets() > 1 && geometry.misses(out.positions[vertex]) ? 1 : 0;
    // A vertex on two charts would slide from one to the other.
    const bool onOne = topology.charts().size() == 1;
    out.classification.classes[vertex] = onOne && !out.compromised[vertex] ? VertexClass::surface : VertexClass::fixed;
    if (out.classification.classes[vertex] == VertexClass::surface)
    {
      part.charts.emplace_back(vertex, topology.charts().front());
    }
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
    const bool onCurve = corner == noIndex && vertex.kind == ChainVertex::along && !geometry.isOnSide();
    out.classification.classes[vertex.vertex] =
        onCurve && !out.compromised[vertex.vertex] ? VertexClass::curve : VertexClass::fixed;
  }

  /// Puts a vertex whose octant the curve does not pass between its neighbors on the curve.
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
    for (const Index e : cuts)
    {
      const CrossedEdge& edge = crossings.crossedEdges[e];
      edges.push_back(seenFrom(leaf, edge.segment, crossings.of(edge)));
      geometry.addCut(edge.segment, crossings.of(edge));
    }
    topology.analyze(leaf, edges);
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

/// Returns the middle between the two vertices that a vertex is linked with; nullopt if there are not two.
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

/// Returns the model's curves by the charts that end there.
std::map<std::vector<Index>, std::vector<Index>> curvesByEnding(const SurfaceModel& model)
{
  std::map<std::vector<Index>, std::vector<Index>> curves;
  for (Index c = 0; c < model.curves.size(); ++c)
  {
    if (!model.curves[c].ending.empty())
    {
      curves[model.curves[c].ending].push_back(c);
    }
  }
  return curves;
}

/// Detaches vertices that lie in one place, as several may where a curve ends on a domain side. All except the one that
/// has the corner, or else the first, may leave the curve for its charts. Returns their places in the chain.
std::vector<Index> detachCoincident(const std::vector<ChainVertex>& chain, const std::vector<Index>& corners,
                                    DualVertices& vertices)
{
  std::map<std::array<double, 3>, std::vector<Index>> byPlace;
  for (Index i = 0; i < chain.size(); ++i)
  {
    if (vertices.classification.classes[chain[i].vertex] == VertexClass::fixed)
    {
      const Vec3& p = vertices.positions[chain[i].vertex];
      byPlace[{p[0], p[1], p[2]}].push_back(i);
    }
  }
  std::vector<Index> detached;
  for (const auto& [place, members] : byPlace)
  {
    const auto holder = std::ranges::find_if(members, [&](Index i) { return corners[i] != noIndex; });
    const Index kept = holder != members.end() ? *holder : members.front();
    for (const Index i : members)
    {
      if (i != kept)
      {
        vertices.classification.classes[chain[i].vertex] = VertexClass::surface;
        detached.push_back(i);
      }
    }
  }
  return detached;
}

void fillPieces(VertexClassification& classification, const std::vector<Part>& parts,
                const std::vector<ChainVertex>& chain, const std::vector<Index>& parted, const SurfaceModel& model)
{
  std::vector<std::pair<Index, Index>> pieces;
  for (const Part& part : parts)
  {
    pieces.insert(pieces.end(), part.charts.begin(), part.charts.end());
  }
  for (const Index v : parted)
  {
    for (const Index chart : chain[v].charts)
    {
      pieces.emplace_back(chain[v].vertex, chart);
    }
  }
  const auto curves = chain.empty() ? decltype(curvesByEnding(model)){} : curvesByEnding(model);
  for (const ChainVertex& vertex : chain)
  {
    if (classification.classes[vertex.vertex] != VertexClass::curve)
    {
      continue;
    }
    const std::size_t before = pieces.size();
    for (const std::vector<Index>& ending : vertex.curves)
    {
      const auto found = curves.find(ending);
      for (const Index curve : found != curves.end() ? found->second : std::vector<Index>())
      {
        pieces.emplace_back(vertex.vertex, curve);
      }
    }
    // Folds within a chart have no name to find them by.
    classification.classes[vertex.vertex] = pieces.size() > before ? VertexClass::curve : VertexClass::fixed;
  }
  std::sort(pieces.begin(), pieces.end());
  classification.offsets.assign(classification.classes.size() + 1, 0);
  for (const auto& [vertex, piece] : pieces)
  {
    ++classification.offsets[vertex + 1];
    classification.pieces.push_back(piece);
  }
  for (std::size_t v = 0; v < classification.classes.size(); ++v)
  {
    classification.offsets[v + 1] += classification.offsets[v];
  }
}

/// Detaches vertices of clusters, and vertices that are not where they should be. Elements around them are better, and
/// valid sooner, if they give way. Vertices at sides of a turned domain stay there.
void detachUnresolved(const Octree& octree, const SurfaceModel& model, const Buckets& cutsOf, DualVertices& vertices)
{
  constexpr double reach = 0.25; // octants
  VertexClassification& classification = vertices.classification;
  for (Index v = 0; v < classification.classes.size(); ++v)
  {
    const Index leaf = classification.leaves[v];
    const bool isInCluster = octree.featureType(leaf) == FeatureType::cluster && !cutsOf.of(leaf).empty();
    if ((isInCluster || vertices.compromised[v]) && !hasTurnedSide(octree, leaf, model))
    {
      classification.classes[v] = VertexClass::detached;
      classification.displacementLimits[v] = {vertices.positions[v], reach * octree.frame().sizeOf(octree.level(leaf))};
    }
  }
}

} // namespace

DualVertices placeVertices(const Octree& octree, const SurfaceModel& model, const Crossings& crossings,
                           const std::vector<Index>& leaves, const RunContext& context)
{
  const Buckets byLeaf = edgesByLeaf(crossings, octree.leafCount(), context);
  const LeafCurves curves(octree, model, context);
  DualVertices vertices;
  vertices.positions.resize(leaves.size());
  vertices.compromised.resize(leaves.size());
  vertices.classification.classes.resize(leaves.size());
  vertices.classification.leaves = leaves;
  constexpr std::size_t grain = 4096;
  std::vector<Part> parts((leaves.size() + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    context.progress.check();
    VertexPlacer placer(octree, model, curves, crossings);
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, leaves.size()); ++i)
    {
      placer.placeOrNote(static_cast<Index>(i), leaves[i], byLeaf.of(leaves[i]), vertices, parts[part]);
    }
  });
  std::vector<ChainVertex> chain;
  for (Part& part : parts)
  {
    std::move(part.chain.begin(), part.chain.end(), std::back_inserter(chain));
  }
  const std::vector<Index> corners = assignCorners(octree, model, chain);
  context.executor.forRanges(chain.size(), 256, [&](std::size_t begin, std::size_t end) {
    VertexPlacer placer(octree, model, curves, crossings);
    for (std::size_t i = begin; i < end; ++i)
    {
      placer.placeOnChain(chain[i], corners[i], byLeaf.of(chain[i].leaf), vertices);
    }
  });
  VertexPlacer placer(octree, model, curves, crossings);
  for (const ChainVertex& vertex : chain)
  {
    if (const auto middle = vertex.isDiverted ? middleOfLinks(vertex, chain, vertices.positions) : std::nullopt)
    {
      placer.placeBetween(vertex, *middle, byLeaf.of(vertex.leaf), vertices);
    }
  }
  fillPieces(vertices.classification, parts, chain, detachCoincident(chain, corners, vertices), model);
  detachUnresolved(octree, model, byLeaf, vertices);
  return vertices;
}

void VertexClassification::appendCopyOf(Index vertex)
{
  classes.push_back(classes[vertex]);
  leaves.push_back(leaves[vertex]);
  for (Index i = offsets[vertex]; i < offsets[vertex + 1]; ++i)
  {
    pieces.push_back(Index{pieces[i]});
  }
  offsets.push_back(static_cast<Index>(pieces.size()));
  const auto extend = [vertex](auto& list) {
    if (!list.empty())
    {
      list.push_back(list[vertex]);
    }
  };
  extend(planes);
  extend(turnedSides);
  if (const auto limit = displacementLimits.find(vertex); limit != displacementLimits.end())
  {
    displacementLimits.emplace(static_cast<Index>(classes.size() - 1), DisplacementLimit(limit->second));
  }
}

} // namespace atria
