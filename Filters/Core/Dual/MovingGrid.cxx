// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/MovingGrid.h"

#include "Dual/FeatureCorners.h"

#include <algorithm>

namespace atria {

namespace {

std::uint64_t keyOf(Index point, int direction) { return std::uint64_t{point} << 3 | direction; }

/// f(leaf) for each of the leaves about an edge, once.
template <typename F> void eachLeaf(const EdgeSegment& edge, F&& f)
{
  for (std::size_t i = 0; i < edge.about.size(); ++i)
  {
    const auto here = edge.about.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(edge.about.begin(), here, *here) == here)
    {
      f(*here);
    }
  }
}

} // namespace

MovingGrid::Look::Look(const MovingGrid& grid)
    : probe(grid.tree, grid.surfaces, &grid.triangles), topology_(grid.tree, grid.surfaces, grid.leafCurves)
{
}

MovingGrid::MovingGrid(GridPlaces& places, const SurfaceModel& model, TriangleTreeOnDemand& trianglesOfModel,
                       const Crossings& crossings, const RunContext& context)
    : grid(places), tree(places.octree()), surfaces(model), triangles(trianglesOfModel), home(crossings),
      atCorners(curvesAtCorners(model)), leafCurves(tree, model, context), movedOf(crossings.crossedEdges.size(), noIndex), view(*this)
{
  listEdges();
  findQuestions(context);
}

void MovingGrid::listEdges()
{
  begin.assign(tree.leafCount() + 1, 0);
  for (const CrossedEdge& edge : home.crossedEdges)
  {
    eachLeaf(edge.segment, [&](Index leaf) { ++begin[leaf + 1]; });
  }
  for (std::size_t leaf = 0; leaf + 1 < begin.size(); ++leaf)
  {
    begin[leaf + 1] += begin[leaf];
  }
  edgesOfLeaf.resize(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (Index id = 0; id < home.crossedEdges.size(); ++id)
  {
    eachLeaf(home.crossedEdges[id].segment, [&](Index leaf) { edgesOfLeaf[next[leaf]++] = id; });
  }
}

void MovingGrid::findQuestions(const RunContext& context)
{
  constexpr std::size_t grain = 2048;
  const std::size_t count = tree.leafCount();
  std::vector<std::vector<Index>> parts((count + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    context.progress.check();
    Look of(*this);
    for (std::size_t leaf = part * grain; leaf < std::min((part + 1) * grain, count); ++leaf)
    {
      if (isInQuestion(static_cast<Index>(leaf), of))
      {
        parts[part].push_back(static_cast<Index>(leaf));
      }
    }
  });
  for (const std::vector<Index>& part : parts)
  {
    inQuestion.insert(part.begin(), part.end());
  }
}

/// f(id) for each edge of a leaf that was cut at some time.
template <typename F> void MovingGrid::eachEdge(Index leaf, F&& f) const
{
  for (std::uint32_t i = begin[leaf]; i < begin[leaf + 1]; ++i)
  {
    f(edgesOfLeaf[i]);
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
    const CrossedEdge& edge = home.crossedEdges[id];
    return {edge.segment, edge.other == noIndex, home.of(edge)};
  }
  const Live& edge = moved[movedOf[id]];
  return {edge.segment, edge.leavesDomain, edge.cuts};
}

/// The edge that is stored from this point; noIndex if it was never cut.
Index MovingGrid::idOf(Index point, int direction) const
{
  const auto& edges = home.crossedEdges;
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

/// The edge as it is stored: from its lower point if it has two.
std::pair<Index, int> MovingGrid::stored(Index point, int direction, const GridPlaces::Edge& edge) const
{
  return edge.other != noIndex && !isUpper(direction) ? std::pair(edge.other, opposite(direction))
                                                      : std::pair(point, direction);
}

bool MovingGrid::startsAt(Index point, int direction) const
{
  return stored(point, direction, grid.edge(point, direction)).first == point;
}

std::optional<MovingGrid::Edge> MovingGrid::cutEdge(Index point, int direction) const
{
  const GridPlaces::Edge edge = grid.edge(point, direction);
  if (!edge.exists())
  {
    return std::nullopt;
  }
  const auto [start, along] = stored(point, direction, edge);
  const Index id = idOf(start, along);
  return id == noIndex ? std::nullopt : std::optional<Edge>(at(id));
}

/// The entry of an edge whose cuts are about to change.
MovingGrid::Live& MovingGrid::live(Index point, int direction, const EdgeSegment& segment, bool leavesDomain)
{
  Index id = idOf(point, direction);
  if (id == noIndex)
  {
    id = static_cast<Index>(movedOf.size());
    addedIds.emplace(keyOf(point, direction), id);
    movedOf.push_back(noIndex);
    eachLeaf(segment, [&](Index leaf) { addedOfLeaf[leaf].push_back(id); });
  }
  if (movedOf[id] == noIndex)
  {
    movedOf[id] = static_cast<Index>(moved.size());
    moved.push_back({segment, leavesDomain, {}});
  }
  return moved[movedOf[id]];
}

void MovingGrid::moveTo(Index point, const LatticePoint& place)
{
  if (place == grid.home(point))
  {
    grid.moveHome(point);
  }
  else
  {
    grid.move(point, place);
  }
  for (int direction = 0; direction < 6; ++direction)
  {
    const GridPlaces::Edge edge = grid.edge(point, direction);
    if (!edge.exists())
    {
      continue;
    }
    const auto [start, along] = stored(point, direction, edge);
    const GridPlaces::Edge same = start == point ? edge : grid.edge(start, along);
    const EdgeSegment segment = grid.segment(start, along, same);
    const auto cuts = atria::cutEdge(grid, view.probe, start, same, segment);
    if (cuts.empty() && idOf(start, along) == noIndex)
    {
      continue;
    }
    Live& entry = live(start, along, segment, same.other == noIndex);
    entry.segment = segment;
    entry.cuts.assign(cuts.begin(), cuts.end());
    stale.insert(segment.about.begin(), segment.about.end());
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
  into.about = atria::leavesAbout(leaf, into.edges);
  into.topology_.analyse(leaf, into.edges);
}

int MovingGrid::surplus(Index leaf, Look& into) const
{
  look(leaf, into);
  return std::max(into.topology_.sheets() - 1, 0) + (isTangle(leaf, into) ? 1 : 0);
}

void MovingGrid::addLeaves(Index point, Look& look, double limit, Surplus& sum) const
{
  const auto& leaves = grid.points().leaves[point];
  for (auto leaf = leaves.begin(); leaf != leaves.end() && sum.cost() <= limit; ++leaf)
  {
    sum.leaves += std::find(leaves.begin(), leaf, *leaf) == leaf ? surplus(*leaf, look) : 0;
  }
}

MovingGrid::Surplus MovingGrid::surplusAbout(Index point, Look& look) const
{
  Surplus sum;
  for (int direction = 0; direction < 6; ++direction)
  {
    const auto edge = cutEdge(point, direction);
    sum.cuts += edge ? edge->surplus() : 0;
  }
  addLeaves(point, look, std::numeric_limits<double>::infinity(), sum);
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
  addLeaves(point, look, limit, sum);
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
    const GridPlaces::Edge edge = grid.edge(point, direction);
    if (edge.exists())
    {
      const auto [start, along] = stored(point, direction, edge);
      const GridPlaces::Edge same = start == point ? edge : grid.edge(start, along);
      const EdgeSegment segment = grid.segment(start, along, same, trial);
      const auto cuts = atria::cutEdge(grid, look.probe, start, same, segment, trial);
      look.tried.push_back({idOf(start, along), {segment, same.other == noIndex, {cuts.begin(), cuts.end()}}});
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

bool MovingGrid::isInQuestion(Index leaf, Look& into) const
{
  bool isCut = false;
  bool isCutTwice = false;
  eachEdge(leaf, [&](Index id) {
    const Edge edge = at(id);
    isCut = isCut || !edge.cuts.empty();
    isCutTwice = isCutTwice || edge.surplus() > 0;
  });
  return isCutTwice || (isCut && surplus(leaf, into) > 0);
}

std::vector<Index> MovingGrid::leavesInQuestion()
{
  for (const Index leaf : stale)
  {
    if (isInQuestion(leaf, view))
    {
      inQuestion.insert(leaf);
    }
    else
    {
      inQuestion.erase(leaf);
    }
  }
  stale.clear();
  return {inQuestion.begin(), inQuestion.end()};
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

bool MovingGrid::isBesideTurnedSide(Index point) const
{
  const auto& leaves = grid.points().leaves[point];
  return tree.frame().turnedDomain && std::any_of(leaves.begin(), leaves.end(), [&](Index leaf) {
           return std::ranges::any_of(tree.items(leaf, ModelItem::triangle),
                                      [&](ModelItem piece) { return surfaces.isTurnedSide(piece.index); });
         });
}

} // namespace atria
