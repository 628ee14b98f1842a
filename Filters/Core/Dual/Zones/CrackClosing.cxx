// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/CrackClosing.h"

#include "Octree/Tree/GeometryLists.h"
#include "Support/Numbering.h"

#include <algorithm>

namespace atria {

namespace {

/// True if nothing cuts the edge, which is seen from its lower end or leads out of the domain.
bool isUncut(Index point, int direction, const Crossings& crossings)
{
  const std::int32_t code = crossings.neighbors[point][direction];
  return code >= 0 ? isUpper(direction)
                   : DualMesh::isBoundary(code) && crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)].onDomainSide;
}

/// Adds a cut to a crossed edge, in order of the edge's cuts.
void add(const SurfaceCrossing& cut, CrossedEdge& edge, std::vector<SurfaceCrossing>& cuts)
{
  std::vector<SurfaceCrossing> all(cuts.begin() + edge.begin, cuts.begin() + edge.begin + edge.count);
  all.insert(std::ranges::upper_bound(all, cut.parameter, {}, &SurfaceCrossing::parameter), cut);
  edge.begin = static_cast<std::uint32_t>(cuts.size());
  edge.count = static_cast<std::uint32_t>(all.size());
  cuts.insert(cuts.end(), all.begin(), all.end());
}

/// Returns the edge among the first `count` crossed ones, which are sorted; null if only others are crossed.
CrossedEdge* findCrossed(Crossings& crossings, std::size_t count, const PassingEdge& passage)
{
  const auto edges = std::span(crossings.crossedEdges).first(count);
  const auto keyOf = [](const CrossedEdge& edge) { return std::pair(edge.point, edge.direction); };
  const auto at = std::ranges::lower_bound(edges, passage.edge(), {}, keyOf);
  return at != edges.end() && keyOf(*at) == passage.edge() ? &*at : nullptr;
}

/// Adds the cut of an edge to the crossings, as findCrossings does. Permeable surfaces may cross the edge, too, which
/// is then among the first `count` crossed ones.
void cut(Crossings& crossings, std::size_t count, const GridPlaces& grid, const SurfaceModel& model,
         const PassingEdge& passage)
{
  const GridPlaces::Edge edge = grid.edge(passage.point, passage.direction);
  if (CrossedEdge* crossed = findCrossed(crossings, count, passage))
  {
    add(passage.cut, *crossed, crossings.cuts);
  }
  else
  {
    crossings.crossedEdges.push_back({passage.point, edge.other, passage.direction,
                                      grid.segment(passage.point, passage.direction, edge),
                                      static_cast<std::uint32_t>(crossings.cuts.size()), 1});
    crossings.cuts.push_back(passage.cut);
  }
  const Index tag = model.surfaceIds[passage.cut.triangle];
  const Index chart = model.charts[passage.cut.triangle];
  std::int32_t& code = crossings.neighbors[passage.point][passage.direction];
  if (edge.other == noIndex)
  {
    BoundaryFace& face = crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)];
    face = {passage.point, tag, noIndex, passage.direction, seenFromStart(passage.cut), false, chart};
    return;
  }
  const auto addFace = [&](const BoundaryFace& face) {
    crossings.neighbors[face.element][face.direction] = ~static_cast<std::int32_t>(crossings.boundaryFaces.size());
    crossings.boundaryFaces.push_back(face);
  };
  addFace({passage.point, tag, edge.other, passage.direction, seenFromStart(passage.cut), false, chart});
  addFace({edge.other, tag, passage.point, static_cast<std::uint8_t>(opposite(passage.direction)),
           seenFromEnd(passage.cut), false, chart});
}

/// Returns the edges that pass the bridges of a boundary edge, and the bridges to the next boundary edges at its ends.
std::vector<PassingEdge> passingEdgesOf(Index edge, const BoundaryGaps& gaps, double tolerance,
                                        const SurfaceModel& model, PassageFinder& finder)
{
  const Index triangle = gaps.boundary.edges()[edge].triangle;
  std::vector<PassingEdge> found;
  const auto look = [&](const std::vector<BridgeTriangle>& bridges) {
    for (const BridgeTriangle& bridge : bridges)
    {
      const std::vector<PassingEdge>& passages = finder.through(bridge, triangle);
      found.insert(found.end(), passages.begin(), passages.end());
    }
  };
  for (std::size_t step = 0; step + 1 < gaps.stations[edge].size(); ++step)
  {
    look(gaps.bridge(edge, step, tolerance));
  }
  for (const unsigned which : {0u, 1u})
  {
    const auto ends = gaps.boundary.at(gaps.boundary.edges()[edge].end(which));
    const auto here = std::ranges::find(ends, BoundaryEdges::codeOf({edge, which}));
    if (here != ends.end() && std::next(here) != ends.end())
    {
      look(gaps.cornerBridge(BoundaryEdges::endOf(*here), BoundaryEdges::endOf(*std::next(here)), tolerance, model));
    }
  }
  return found;
}

/// Returns all boundary edges in the order of the leaves of their first stations.
std::vector<Index> edgesInOrderOfLeaves(const BoundaryGaps& gaps, const Octree& octree)
{
  std::vector<std::pair<Index, Index>> sorted;
  for (Index edge = 0; edge < gaps.stations.size(); ++edge)
  {
    const std::vector<BoundaryStation>& stations = gaps.stations[edge];
    const bool isInside = !stations.empty() && octree.frame().inDomain(stations.front().at);
    sorted.emplace_back(isInside ? octree.leafAt(stations.front().at) : noIndex, edge);
  }
  std::ranges::sort(sorted);
  std::vector<Index> edges(sorted.size());
  std::ranges::transform(sorted, edges.begin(), &std::pair<Index, Index>::second);
  return edges;
}

} // namespace

void forBoundaryEdges(const BoundaryGaps& gaps, const Crossings& crossings, const GridPlaces& grid,
                      const RunContext& context, const std::function<void(Index, PassageFinder&)>& use)
{
  constexpr std::size_t grain = 64;
  const std::vector<Index> edges = edgesInOrderOfLeaves(gaps, grid.octree());
  context.executor.forRanges(edges.size(), grain, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    PassageFinder finder(crossings, grid);
    for (std::size_t i = begin; i < end; ++i)
    {
      use(edges[i], finder);
    }
  });
}

const std::vector<PassingEdge>& PassageFinder::through(const BridgeTriangle& bridge, Index triangle)
{
  const GridFrame& frame = grid_.octree().frame();
  const LatticePoint& at = bridge.front();
  const std::int64_t size = frame.inDomain(at) ? frame.latticeSize(grid_.octree().level(grid_.octree().leafAt(at))) : 0;
  // Edges with an end that was moved lie off their leaves, by up to an octant.
  const LatticeBox about = grown(boundsOf(bridge[0], bridge[1], bridge[2]), grid_.displacedCount() == 0 ? 0 : size);
  if (!gathered_ || !gathered_->contains(about.low) || !gathered_->contains(about.high))
  {
    gather(grown(about, size / 2)); // the next bridges are near
  }
  found_.clear();
  for (const UncutEdge& edge : edges_)
  {
    if (const auto cut = crossingOf(edge.segment, bridge[0], bridge[1], bridge[2], triangle))
    {
      found_.push_back({edge.point, edge.direction, *cut});
    }
  }
  return found_;
}

/// Gathers the uncut edges at the corners of the leaves around a box.
void PassageFinder::gather(const LatticeBox& box)
{
  gathered_ = box;
  const std::vector<Index> leaves = leavesTouching(grid_.octree(), box);
  std::vector<Index> points;
  Numbering numbers(2 * leaves.size());
  for (const Index leaf : leaves)
  {
    for (const Index point : grid_.points().atCorner[leaf])
    {
      if (point != noIndex)
      {
        numbers.findOrAdd(point, points);
      }
    }
  }
  edges_.clear();
  for (const Index point : points)
  {
    for (std::uint8_t direction = 0; direction < 6; ++direction)
    {
      if (isUncut(point, direction, crossings_))
      {
        edges_.push_back({point, direction, grid_.segment(point, direction, grid_.edge(point, direction))});
      }
    }
  }
}

Crossings closeCracks(Crossings crossings, const BoundaryGaps& gaps, const GridPlaces& grid, double tolerance,
                      const MeshingContext& context)
{
  if (!(tolerance > 0.0))
  {
    return crossings;
  }
  std::vector<std::vector<PassingEdge>> found(gaps.stations.size());
  forBoundaryEdges(gaps, crossings, grid, context, [&](Index edge, PassageFinder& finder) {
    found[edge] = passingEdgesOf(edge, gaps, tolerance, context.model, finder);
  });
  std::vector<PassingEdge> passages;
  for (const auto& part : found)
  {
    passages.insert(passages.end(), part.begin(), part.end());
  }
  std::sort(passages.begin(), passages.end());
  const std::size_t crossedBefore = crossings.crossedEdges.size();
  for (std::size_t i = 0; i < passages.size(); ++i)
  {
    if (i == 0 || passages[i].edge() != passages[i - 1].edge())
    {
      cut(crossings, crossedBefore, grid, context.model, passages[i]);
    }
  }
  return crossings;
}

} // namespace atria
