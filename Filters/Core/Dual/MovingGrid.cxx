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

MovingGrid::MovingGrid(GridPlaces& places, const SurfaceModel& model, TriangleTreeOnDemand& triangles,
                       const Crossings& crossings, const RunContext& context)
    : grid(places), tree(places.octree()), surfaces(model), home(crossings), probe(tree, model, &triangles),
      atCorners(curvesAtCorners(model)),
      movedOf(crossings.crossedEdges.size(), noIndex), view{{}, LeafTopology(tree, model), {}}
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
  constexpr std::size_t grain = 8192;
  const std::size_t count = tree.leafCount();
  std::vector<std::vector<Index>> parts((count + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    context.progress.check();
    View of{{}, LeafTopology(tree, surfaces), {}};
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

template <typename F> void MovingGrid::eachEdge(Index leaf, F&& f) const
{
  for (std::uint32_t i = begin[leaf]; i < begin[leaf + 1]; ++i)
  {
    f(at(edgesOfLeaf[i]));
  }
  if (const auto found = addedOfLeaf.find(leaf); found != addedOfLeaf.end())
  {
    for (const Index id : found->second)
    {
      f(at(id));
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
    const auto cuts = atria::cutEdge(grid, probe, start, same, segment);
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

void MovingGrid::look(Index leaf, View& into) const
{
  into.edges.clear();
  eachEdge(leaf, [&](const Edge& edge) {
    if (!edge.cuts.empty())
    {
      into.edges.push_back(seenFrom(leaf, edge.segment, edge.cuts));
    }
  });
  into.about = atria::leavesAbout(leaf, into.edges);
  into.topology.analyse(leaf, into.edges);
}

int MovingGrid::surplus(Index leaf) { return surplus(leaf, view); }

int MovingGrid::surplus(Index leaf, View& into) const
{
  look(leaf, into);
  return std::max(into.topology.sheets() - 1, 0) + (isTangle(leaf, into) ? 1 : 0);
}

/// Whether curves meet or end at the vertex of a leaf, but at no corner near it.
bool MovingGrid::isTangle(Index leaf, const View& of) const
{
  const bool onSide = tree.frame().domainPlanes(tree.lowCorner(leaf), tree.highCorner(leaf)) != 0;
  if (!of.topology.isKnot() || (of.topology.isEnd() && onSide))
  {
    return false;
  }
  const auto curves = of.topology.curves();
  return std::none_of(of.about.begin(), of.about.end(), [&](Index near) {
    const auto items = tree.items(near);
    return std::any_of(items.begin(), items.end(), [&](ModelItem piece) {
      return piece.kind == ModelItem::corner &&
             std::includes(atCorners[piece.index].begin(), atCorners[piece.index].end(), curves.begin(), curves.end());
    });
  });
}

bool MovingGrid::isInQuestion(Index leaf, View& into) const
{
  bool isCut = false;
  bool isCutTwice = false;
  eachEdge(leaf, [&](const Edge& edge) {
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
           const auto items = tree.items(leaf);
           return std::any_of(items.begin(), items.end(), [&](ModelItem piece) {
             return piece.kind == ModelItem::triangle && surfaces.isTurnedSide(piece.index);
           });
         });
}

} // namespace atria
