// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Displacement/MovingGrid.h"

#include "Dual/Leaf/FeatureCorners.h"
#include "Support/Pieces.h"
#include "Support/Sorting.h"

#include <algorithm>

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
      edgesOfLeaf(edgesByLeaf(crossings, tree.leafCount(), context)), movedOf(crossings.crossedEdges.size(), noIndex),
      view(*this)
{
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

/// f(id) for each edge of a leaf that was cut at some time.
template <typename F> void MovingGrid::eachEdge(Index leaf, F&& f) const
{
  for (const Index id : edgesOfLeaf.of(leaf))
  {
    f(id);
  }
  if (const auto found = addedOfLeaf.find(leaf); found != addedOfLeaf.end())
  {
    for (const Index id : found->second)
    {
      f(id);
    }
  }
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

/// The edge that is stored from this point; noIndex if it was never cut.
Index MovingGrid::idOf(Index point, int direction) const
{
  const auto& edges = undisplaced.crossedEdges;
  const auto found = std::lower_bound(edges.begin(), edges.end(), std::pair(point, direction),
                                      [](const CrossedEdge& edge, const std::pair<Index, int>& wanted) {
                                        return std::pair<Index, int>(edge.point, edge.direction) < wanted;
                                      });
  if (found != edges.end() && found->point == point && found->direction == direction)
  {
    return static_cast<Index>(found - edges.begin());
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

/// The entry of an edge whose cuts are about to change.
MovingGrid::Live& MovingGrid::live(const Stored& edge, const EdgeSegment& segment)
{
  Index id = idOf(edge.start, edge.along);
  if (id == noIndex)
  {
    id = static_cast<Index>(movedOf.size());
    addedIds.emplace(keyOf(edge.start, edge.along), id);
    movedOf.push_back(noIndex);
    eachLeaf(segment.about, [&](Index leaf) { addedOfLeaf[leaf].push_back(id); });
  }
  if (movedOf[id] == noIndex)
  {
    movedOf[id] = static_cast<Index>(moved.size());
    moved.push_back({segment, edge.edge.other == noIndex, {}});
  }
  return moved[movedOf[id]];
}

void MovingGrid::setCuts(const Stored& edge, const EdgeSegment& segment, std::span<const SurfaceCrossing> cuts)
{
  if (cuts.empty() && idOf(edge.start, edge.along) == noIndex)
  {
    return;
  }
  Live& entry = live(edge, segment);
  entry.segment = segment;
  entry.cuts.assign(cuts.begin(), cuts.end());
  for (const Index leaf : segment.about)
  {
    if (!findings[leaf].isStale)
    {
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

void MovingGrid::moveTo(Index point, const LatticePoint& place)
{
  putAt(point, place);
  for (int direction = 0; direction < 6; ++direction)
  {
    if (const auto edge = stored(point, direction))
    {
      const EdgeSegment segment = grid.segment(edge->start, edge->along, edge->edge);
      setCuts(*edge, segment, atria::cutEdge(grid, view.probe, edge->start, edge->edge, segment));
    }
  }
}

/// An edge between two points that move is told its cuts by the later one. Edges are numbered as they are first cut,
/// though, which may be while only the first has moved: that is looked at before any moves.
void MovingGrid::moveAll(const PointPlaces& places, const RunContext& context)
{
  constexpr std::size_t grain = 16;
  std::vector<std::uint8_t> halfway(places.size());
  context.executor.forRanges(places.size(), grain, [&](std::size_t first, std::size_t last) {
    Look look(*this);
    for (std::size_t i = first; i < last; ++i)
    {
      halfway[i] = cutHalfway(places[i], places, look);
    }
  });
  for (const auto& [point, place] : places)
  {
    putAt(point, place);
  }
  std::vector<NewCuts> parts((places.size() + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    Look look(*this);
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, places.size()); ++i)
    {
      cutAnew(places[i].first, halfway[i], places, look, parts[part]);
    }
  });
  for (const NewCuts& part : parts)
  {
    for (const NewCuts::Of& found : part.edges)
    {
      if (found.isHalfway)
      {
        live(found.edge, found.segment);
      }
      else
      {
        setCuts(found.edge, found.segment, std::span(part.cuts).subspan(found.begin, found.end - found.begin));
      }
    }
  }
}

/// Whether the edge leads from a point to one that moves later.
bool MovingGrid::movesLater(const Stored& edge, Index point, const PointPlaces& places)
{
  const Index other = edge.start == point ? edge.edge.other : edge.start;
  const auto found = std::ranges::lower_bound(places, other, {}, &PointPlaces::value_type::first);
  return other != noIndex && other > point && found != places.end() && found->first == other;
}

/// The directions in which there are edges to points that move later, which never were cut and are while those stay.
std::uint8_t MovingGrid::cutHalfway(const PointPlaces::value_type& move, const PointPlaces& places, Look& look) const
{
  const GridTrial trial{move.first, move.second};
  unsigned directions = 0;
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto edge = stored(move.first, direction);
    if (edge && movesLater(*edge, move.first, places) && idOf(edge->start, edge->along) == noIndex)
    {
      const EdgeSegment segment = grid.segment(edge->start, edge->along, edge->edge, trial);
      const bool isCut = !atria::cutEdge(grid, look.probe, edge->start, edge->edge, segment, trial).empty();
      directions |= isCut ? 1u << direction : 0u;
    }
  }
  return static_cast<std::uint8_t>(directions);
}

/// Cuts the edges of a point, but for those to points that move later.
void MovingGrid::cutAnew(Index point, std::uint8_t halfway, const PointPlaces& places, Look& look, NewCuts& out) const
{
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto edge = stored(point, direction);
    const bool isHalfway = (halfway >> direction & 1) != 0;
    if (!edge || (!isHalfway && movesLater(*edge, point, places)))
    {
      continue;
    }
    const EdgeSegment segment = grid.segment(edge->start, edge->along, edge->edge);
    const std::size_t before = out.cuts.size();
    if (!isHalfway)
    {
      const auto cuts = atria::cutEdge(grid, look.probe, edge->start, edge->edge, segment);
      out.cuts.insert(out.cuts.end(), cuts.begin(), cuts.end());
    }
    out.edges.push_back({*edge, segment, before, out.cuts.size(), isHalfway});
  }
}

void MovingGrid::look(Index leaf, Look& into) const
{
  into.edges.clear();
  const auto add = [&](const EdgeSegment& segment, std::span<const SurfaceCrossing> cuts) {
    if (!cuts.empty())
    {
      into.edges.push_back(seenFrom(leaf, segment, cuts));
    }
  };
  eachEdge(leaf, [&](Index id) {
    if (std::ranges::find(into.tried, id, &Look::Tried::id) == into.tried.end())
    {
      const Edge edge = at(id);
      add(edge.segment, edge.cuts);
    }
  });
  for (const Look::Tried& one : into.tried)
  {
    if (std::ranges::find(one.edge.segment.about, leaf) != one.edge.segment.about.end())
    {
      add(one.edge.segment, one.edge.cuts);
    }
  }
  listLeavesAbout(leaf, into.edges, into.about);
  into.topology_.analyze(leaf, into.edges);
}

int MovingGrid::surplus(Index leaf, Look& into) const
{
  look(leaf, into);
  return std::max(into.topology_.sheets() - 1, 0) + (isTangle(leaf, into) ? 1 : 0);
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

MovingGrid::Surplus MovingGrid::surplusAbout(Index point, const LatticePoint& place, Look& look, double limit) const
{
  tryEdges(point, place, look);
  Surplus sum;
  for (const Look::Tried& one : look.tried)
  {
    sum.cuts += Edge{one.edge.segment, one.edge.leavesDomain, one.edge.cuts}.surplus();
  }
  eachLeaf(grid.points().leaves[point],
           [&](Index leaf) { sum.leaves += sum.cost() <= limit ? surplus(leaf, look) : 0; });
  look.tried.clear();
  return sum;
}

/// The edges of a point as they would be with it at this place.
void MovingGrid::tryEdges(Index point, const LatticePoint& place, Look& look) const
{
  const GridTrial trial{point, place};
  look.tried.clear();
  for (int direction = 0; direction < 6; ++direction)
  {
    if (const auto edge = stored(point, direction))
    {
      const EdgeSegment segment = grid.segment(edge->start, edge->along, edge->edge, trial);
      const auto cuts = atria::cutEdge(grid, look.probe, edge->start, edge->edge, segment, trial);
      look.tried.push_back(
          {idOf(edge->start, edge->along), {segment, edge->edge.other == noIndex, {cuts.begin(), cuts.end()}}});
    }
  }
}

/// Whether curves meet or end at the vertex of a leaf, but at no corner near it.
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

/// Nothing of clusters: there is nothing to be gained.
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

void MovingGrid::lookAgain(Index point)
{
  eachLeaf(grid.points().leaves[point], [&](Index leaf) { isUnresolved(leaf); });
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
  const auto hasTurnedSide = [&](Index leaf) {
    return std::ranges::any_of(tree.items(leaf, ModelItem::triangle),
                               [&](ModelItem piece) { return surfaces.isTurnedSide(piece.index); });
  };
  return std::ranges::any_of(grid.points().leaves[point], [&](Index leaf) {
    return tree.featureType(leaf) == FeatureType::cluster || (tree.frame().turnedDomain && hasTurnedSide(leaf));
  });
}

} // namespace atria
