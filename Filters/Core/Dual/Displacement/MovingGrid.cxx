// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/MovingGrid.h"

#include "Dual/Leaf/FeatureCorners.h"
#include "Octree/Tree/GeometryLists.h"
#include "Support/Pieces.h"
#include "Support/Sorting.h"

#include <algorithm>
#include <numeric>

namespace atria {

namespace {

std::uint64_t keyOf(Index point, int direction) { return std::uint64_t{point} << 3 | direction; }

} // namespace

MovingGrid::Look::Look(const MovingGrid& grid)
    : probe(grid.tree, grid.surfaces, &grid.triangles), topology_(grid.tree, grid.surfaces, grid.leafCurves)
{
}

MovingGrid::MovingGrid(GridPlaces& places, const Crossings& crossings, const MeshingContext& context)
    : grid(places), tree(context.octree), surfaces(context.model), triangles(context.tree), undisplaced(crossings),
      atCorners(curvesAtCorners(surfaces)), leafCurves(tree, surfaces, context),
      edgesOfLeaf(edgesByLeaf(crossings, tree.leafCount(), context)), firstEdge(places.points().size() + 1, 0),
      movedOf(crossings.crossedEdges.size(), noIndex), view(*this)
{
  for (const CrossedEdge& edge : crossings.crossedEdges)
  {
    ++firstEdge[edge.point + 1];
  }
  std::partial_sum(firstEdge.begin(), firstEdge.end(), firstEdge.begin());
  findUnresolved(context);
}

void MovingGrid::findUnresolved(const RunContext& context)
{
  constexpr std::size_t grain = 512;
  findings.resize(tree.leafCount());
  context.executor.forRanges(findings.size(), grain, [&](std::size_t first, std::size_t last) {
    context.progress.check();
    Look of(*this);
    for (std::size_t leaf = first; leaf < last; ++leaf)
    {
      findings[leaf] = find(static_cast<Index>(leaf), of);
    }
  });
  unresolved = chosenNumbers(findings.size(), context.executor,
                             [&](std::size_t leaf) { return findings[leaf].unresolved != 0; });
}

MovingGrid::Edge MovingGrid::at(Index id) const
{
  if (movedOf[id] == noIndex)
  {
    const CrossedEdge& edge = undisplaced.crossedEdges[id];
    return {edge.segment, edge.other == noIndex, undisplaced.of(edge)};
  }
  const Live& edge = moved[movedOf[id]];
  return {edge.segment, edge.leavesDomain, edge.cuts};
}

/// Returns the number of the edge that is stored from this point; noIndex if it was never cut.
Index MovingGrid::idOf(Index point, int direction) const
{
  for (Index id = firstEdge[point]; id < firstEdge[point + 1]; ++id)
  {
    if (undisplaced.crossedEdges[id].direction == direction)
    {
      return id;
    }
  }
  const auto added = addedIds.find(keyOf(point, direction));
  return added == addedIds.end() ? noIndex : added->second;
}

std::optional<MovingGrid::Stored> MovingGrid::stored(Index point, int direction) const
{
  const GridPlaces::Edge edge = grid.edge(point, direction);
  if (!edge.exists())
  {
    return std::nullopt;
  }
  if (edge.other == noIndex || isUpper(direction))
  {
    return Stored{point, direction, edge};
  }
  return Stored{edge.other, opposite(direction), grid.edge(edge.other, opposite(direction))};
}

bool MovingGrid::startsAt(Index point, int direction) const
{
  const GridPlaces::Edge edge = grid.edge(point, direction);
  return edge.other == noIndex || isUpper(direction);
}

std::optional<MovingGrid::Edge> MovingGrid::cutEdge(Index point, int direction) const
{
  const GridPlaces::Edge edge = grid.edge(point, direction);
  if (!edge.exists())
  {
    return std::nullopt;
  }
  const bool starts = edge.other == noIndex || isUpper(direction);
  const Index id = starts ? idOf(point, direction) : idOf(edge.other, opposite(direction));
  return id == noIndex ? std::nullopt : std::optional<Edge>(at(id));
}

/// Returns the entry of an edge whose cuts are about to change.
MovingGrid::Live& MovingGrid::live(const Stored& edge, const EdgeSegment& segment)
{
  Index id = idOf(edge.start, edge.along);
  if (id == noIndex)
  {
    id = static_cast<Index>(movedOf.size());
    addedIds.emplace(keyOf(edge.start, edge.along), id);
    addedKeys.push_back(keyOf(edge.start, edge.along));
    movedOf.push_back(noIndex);
    const auto keyOfAdded = [&](Index added) { return addedKeys[added - undisplaced.crossedEdges.size()]; };
    eachLeaf(segment.about, [&](Index leaf) {
      // The order does not depend on which edge was cut first.
      std::vector<Index>& ids = addedOfLeaf[leaf];
      ids.insert(std::ranges::upper_bound(ids, addedKeys.back(), {}, keyOfAdded), id);
    });
  }
  if (movedOf[id] == noIndex)
  {
    movedOf[id] = static_cast<Index>(moved.size());
    moved.push_back({segment, edge.edge.other == noIndex, {}});
  }
  return moved[movedOf[id]];
}

/// Sets the cuts of an edge. Nothing changes for its leaves if the same charts cut it as before.
void MovingGrid::setCuts(const Stored& edge, const EdgeSegment& segment, std::span<const SurfaceCrossing> cuts,
                         Trail* trail)
{
  const Index id = idOf(edge.start, edge.along);
  if (cuts.empty() && id == noIndex)
  {
    return;
  }
  const auto before = id == noIndex ? std::span<const SurfaceCrossing>() : at(id).cuts;
  const auto chartOf = [&](const SurfaceCrossing& cut) { return surfaces.charts[cut.triangle]; };
  const bool isSame = std::ranges::equal(before, cuts, {}, chartOf, chartOf);
  if (trail)
  {
    const EdgeSegment& was = id == noIndex ? segment : at(id).segment;
    trail->edges.push_back({edge, {was, edge.edge.other == noIndex, {before.begin(), before.end()}}});
  }
  Live& entry = live(edge, segment);
  entry.segment = segment;
  entry.cuts.assign(cuts.begin(), cuts.end());
  for (const Index leaf : segment.about)
  {
    if (!isSame && !findings[leaf].isStale)
    {
      if (trail)
      {
        trail->leaves.emplace_back(leaf, findings[leaf]);
      }
      findings[leaf].isStale = 1;
      stale.push_back(leaf);
    }
  }
}

void MovingGrid::putAt(Index point, const LatticePoint& place)
{
  if (place == grid.undisplaced(point))
  {
    grid.undisplace(point);
  }
  else
  {
    grid.move(point, place);
  }
}

/// Returns the edges of these points, each once.
std::vector<MovingGrid::Stored> MovingGrid::edgesOf(const PointPlaces& places) const
{
  std::vector<Stored> edges;
  for (const auto& [point, place] : places)
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      if (const auto edge = stored(point, direction))
      {
        edges.push_back(*edge);
      }
    }
  }
  if (places.size() > 1)
  {
    sortUnique(edges);
  }
  return edges;
}

void MovingGrid::moveTogether(const PointPlaces& places, Trail* trail)
{
  ++version;
  for (const auto& [point, place] : places)
  {
    if (trail)
    {
      trail->places.emplace_back(point, grid.place(point));
    }
    putAt(point, place);
  }
  for (const Stored& edge : edgesOf(places))
  {
    const EdgeSegment segment = grid.segment(edge.start, edge.along, edge.edge);
    setCuts(edge, segment, atria::cutEdge(grid, view.probe, edge.start, edge.edge, segment), trail);
  }
}

void MovingGrid::takeBack(const Trail& trail)
{
  ++version;
  for (auto move = trail.places.rbegin(); move != trail.places.rend(); ++move)
  {
    putAt(move->first, move->second);
  }
  for (auto change = trail.edges.rbegin(); change != trail.edges.rend(); ++change)
  {
    live(change->first, change->second.segment) = change->second;
  }
  for (auto change = trail.leaves.rbegin(); change != trail.leaves.rend(); ++change)
  {
    findings[change->first] = change->second;
  }
}

void MovingGrid::moveAll(const PointPlaces& places, const RunContext& context)
{
  constexpr std::size_t grain = 64;
  ++version;
  for (const auto& [point, place] : places)
  {
    putAt(point, place);
  }
  const std::vector<Stored> edges = edgesOf(places);
  std::vector<EdgeSegment> segments(edges.size());
  std::vector<std::vector<SurfaceCrossing>> cuts(edges.size());
  context.executor.forRanges(edges.size(), grain, [&](std::size_t first, std::size_t last) {
    EdgeProbe probe(tree, surfaces, &triangles);
    for (std::size_t i = first; i < last; ++i)
    {
      segments[i] = grid.segment(edges[i].start, edges[i].along, edges[i].edge);
      const auto found = atria::cutEdge(grid, probe, edges[i].start, edges[i].edge, segments[i]);
      cuts[i].assign(found.begin(), found.end());
    }
  });
  for (std::size_t i = 0; i < edges.size(); ++i)
  {
    setCuts(edges[i], segments[i], cuts[i]);
  }
}

/// Returns the surplus of a leaf from the edges of its look.
int MovingGrid::analyze(Index leaf, Look& into) const
{
  listLeavesAbout(leaf, into.edges, into.about);
  into.topology_.analyze(leaf, into.edges);
  return std::max(into.topology_.sheets() - 1, 0) + (isTangle(leaf, into) ? 1 : 0);
}

int MovingGrid::surplus(Index leaf, Look& into) const
{
  into.edges.clear();
  eachEdge(leaf, [&](Index id) {
    const Edge edge = at(id);
    if (!edge.cuts.empty())
    {
      into.edges.push_back(seenFrom(leaf, edge.segment, edge.cuts));
    }
  });
  return analyze(leaf, into);
}

MovingGrid::Surplus MovingGrid::surplusAbout(Index point, Look& look) const
{
  Surplus sum;
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto edge = cutEdge(point, direction);
    sum.cuts += edge ? edge->surplus() : 0;
  }
  eachLeaf(grid.points().leaves[point], [&](Index leaf) {
    sum.leaves += findings[leaf].isStale ? surplus(leaf, look) : static_cast<int>(findings[leaf].surplus);
  });
  return sum;
}

MovingGrid::Surplus MovingGrid::surplusAbout(const PointPlaces& places)
{
  Surplus sum;
  for (const Stored& edge : edgesOf(places))
  {
    const Index id = idOf(edge.start, edge.along);
    sum.cuts += id == noIndex ? 0 : at(id).surplus();
  }
  std::vector<Index> leaves;
  for (const auto& [point, place] : places)
  {
    leaves.insert(leaves.end(), grid.points().leaves[point].begin(), grid.points().leaves[point].end());
  }
  sortUnique(leaves);
  for (const Index leaf : leaves)
  {
    isUnresolved(leaf);
    sum.leaves += static_cast<int>(findings[leaf].surplus);
  }
  return sum;
}

/// True if curves meet or end at the vertex of a leaf, but at no corner near it.
bool MovingGrid::isTangle(Index leaf, const Look& of) const
{
  const bool onSide = tree.frame().domainPlanes(tree.lowCorner(leaf), tree.highCorner(leaf)) != 0;
  if (!of.topology_.isKnot() || (of.topology_.isEnd() && onSide))
  {
    return false;
  }
  const auto curves = of.topology_.curves();
  return std::none_of(of.about.begin(), of.about.end(), [&](Index near) {
    return std::ranges::any_of(tree.items(near, ModelItem::corner),
                               [&](ModelItem piece) { return std::ranges::includes(atCorners[piece.index], curves); });
  });
}

/// Returns what is found in a leaf: nothing in clusters, as nothing can be gained there.
MovingGrid::Finding MovingGrid::find(Index leaf, Look& into) const
{
  if (tree.featureType(leaf) == FeatureType::cluster)
  {
    return {};
  }
  bool isCut = false;
  bool isCutTwice = false;
  eachEdge(leaf, [&](Index id) {
    const Edge edge = at(id);
    isCut = isCut || !edge.cuts.empty();
    isCutTwice = isCutTwice || edge.surplus() > 0;
  });
  Finding found;
  found.surplus = isCut ? static_cast<std::uint32_t>(surplus(leaf, into)) & 0x3fffffffu : 0;
  found.unresolved = isCutTwice || found.surplus > 0 ? 1 : 0;
  return found;
}

bool MovingGrid::isUnresolved(Index leaf)
{
  if (findings[leaf].isStale)
  {
    findings[leaf] = find(leaf, view);
    looked.push_back(leaf);
  }
  return findings[leaf].unresolved != 0;
}

void MovingGrid::lookAgain(const RunContext& context)
{
  constexpr std::size_t grain = 4;
  sortUnique(stale);
  context.executor.forRanges(stale.size(), grain, [&](std::size_t first, std::size_t last) {
    Look of(*this);
    for (std::size_t i = first; i < last; ++i)
    {
      if (findings[stale[i]].isStale)
      {
        findings[stale[i]] = find(stale[i], of);
      }
    }
  });
  looked.insert(looked.end(), stale.begin(), stale.end());
  if (looked.size() > findings.size())
  {
    sortUnique(looked);
  }
  stale.clear();
}

const std::vector<Index>& MovingGrid::unresolvedLeaves(const RunContext& context)
{
  lookAgain(context);
  const auto isCalm = [&](Index leaf) { return !findings[leaf].unresolved; };
  std::erase_if(unresolved, isCalm);
  std::erase_if(looked, isCalm);
  sortUnique(looked);
  mergeUnique(unresolved, looked);
  looked.clear();
  return unresolved;
}

void MovingGrid::addCorners(Index leaf, std::set<Index>& points) const
{
  for (const Index corner : grid.points().atCorner[leaf])
  {
    if (corner != noIndex)
    {
      points.insert(corner);
    }
  }
}

std::int64_t MovingGrid::shortestEdge(Index point) const
{
  int level = 0;
  for (const Index leaf : grid.points().leaves[point])
  {
    level = std::max(level, tree.level(leaf));
  }
  return tree.frame().latticeSize(level);
}

bool MovingGrid::isFixed(Index point) const
{
  return std::ranges::any_of(grid.points().leaves[point], [&](Index leaf) {
    return tree.featureType(leaf) == FeatureType::cluster || hasTurnedSide(tree, leaf, surfaces);
  });
}

} // namespace atria
