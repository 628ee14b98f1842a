// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/ModelViews.h"

#include "Support/UnionFind.h"
#include "Surface/Triangles/EachEdge.h"

#include <algorithm>
#include <atomic>
#include <ranges>

namespace atria {

namespace {

/// Number of votes for each view, for the two sides of a piece.
using Votes = std::array<std::array<std::uint32_t, viewCount>, 2>;

int sideIndex(SheetSide side) { return side == SheetSide::front ? 0 : 1; }

class ViewFinder
{
public:
  ViewFinder(const Crossings& c, const GridPlaces& g, const Zones& z, const std::vector<View>& o, const SurfaceModel& m,
             const GridPart& p, const RunContext& r)
      : crossings(c), grid(g), zones(z), ofZone(o), model(m), part(p), context(r)
  {
  }

  std::vector<TriangleViews> run()
  {
    Index count = 0;
    pieceOf = piecesBetweenEdges(model, count, context.executor);
    views.assign(count, {View::nothing, View::nothing});
    votes.resize(count);
    voteOfSides();
    eachOwnEdge([&](const CrossedEdge& edge) { voteOfEnds(edge); });
    while (decide())
    {
      eachOwnEdge([&](const CrossedEdge& edge) { voteOfNeighbors(edge); });
    }
    std::vector<TriangleViews> out(pieceOf.size());
    std::ranges::transform(pieceOf, out.begin(), [&](Index piece) { return views[piece]; });
    return out;
  }

private:
  View viewAt(Index point) const { return atria::viewAt(point, zones, ofZone); }

  template <typename Visit> void eachOwnEdge(Visit&& visit) const
  {
    context.executor.forEach(crossings.crossedEdges.size(), 2048, [&](std::size_t e) {
      if (part.owns(crossings.crossedEdges[e].point))
      {
        visit(crossings.crossedEdges[e]);
      }
    });
  }

  void vote(Index triangle, SheetSide side, View view)
  {
    if (view != View::nothing)
    {
      std::uint32_t& count = votes[pieceOf[triangle]][sideIndex(side)][static_cast<std::size_t>(view)];
      std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed);
    }
  }

  /// Adds votes for triangles on sides of the domain, which cut no edges: faces with their tags decide.
  void voteOfSides()
  {
    EdgeProbe probe(grid.octree(), model);
    for (const BoundaryFace& face : crossings.boundaryFaces)
    {
      if (!face.onDomainSide || face.tag >= model.names.size() || !part.owns(face.element))
      {
        continue;
      }
      const GridPlaces::Edge edge = grid.edge(face.element, face.direction);
      const EdgeSegment segment = grid.segment(face.element, face.direction, edge);
      const Index triangle = probe.sideTriangle(edge.at.leaf, segment.end, face.direction);
      if (triangle != noIndex)
      {
        const bool pointsUp = model.normal(triangle)[axisOf(face.direction)] > 0.0;
        vote(triangle, pointsUp != isUpper(face.direction) ? SheetSide::front : SheetSide::back, viewAt(face.element));
      }
    }
  }

  void voteOfEnds(const CrossedEdge& edge)
  {
    const std::span<const SurfaceCrossing> cuts = crossings.of(edge);
    bool hasWall = false;
    const auto voteOf = [&](const SurfaceCrossing& cut, SheetSide side, View view) {
      if (model.isPermeable(cut.triangle))
      {
        vote(cut.triangle, SheetSide::front, view);
        vote(cut.triangle, SheetSide::back, view);
        return;
      }
      vote(cut.triangle, side, view);
      hasWall = true;
    };
    const View start = viewAt(edge.point);
    eachSeen(cuts.begin(), cuts.end(), model,
             [&](const SurfaceCrossing& cut) { voteOf(cut, seenFromStart(cut), start); });
    if (hasWall && edge.other != noIndex)
    {
      const View end = viewAt(edge.other);
      eachSeen(cuts.rbegin(), cuts.rend(), model,
               [&](const SurfaceCrossing& cut) { voteOf(cut, seenFromEnd(cut), end); });
    }
  }

  /// Adds votes for sides between two consecutive cuts of an edge, which see one space.
  void voteOfNeighbors(const CrossedEdge& edge)
  {
    const SurfaceCrossing* before = nullptr;
    for (const SurfaceCrossing& cut : crossings.of(edge))
    {
      if (model.isPermeable(cut.triangle))
      {
        continue;
      }
      if (before)
      {
        const View here = viewOf(before->triangle, seenFromEnd(*before));
        const View there = viewOf(cut.triangle, seenFromStart(cut));
        if (here == View::nothing)
        {
          vote(before->triangle, seenFromEnd(*before), there);
        }
        if (there == View::nothing)
        {
          vote(cut.triangle, seenFromStart(cut), here);
        }
      }
      before = &cut;
    }
  }

  View viewOf(Index triangle, SheetSide side) const { return views[pieceOf[triangle]][sideIndex(side)]; }

  /// Gives sides without a view the first one with most votes. Returns true if any side got one.
  bool decide()
  {
    votes = addAll(part.exchange(), std::move(votes), [](const Votes& more, Votes& sum) {
      for (std::size_t i = 0; i < 2 * viewCount; ++i)
      {
        sum[i / viewCount][i % viewCount] += more[i / viewCount][i % viewCount];
      }
    });
    bool any = false;
    for (std::size_t piece = 0; piece < votes.size(); ++piece)
    {
      for (std::size_t side = 0; side < 2; ++side)
      {
        const auto& counts = votes[piece][side];
        const auto most = std::ranges::max_element(counts);
        if (views[piece][side] == View::nothing && *most > 0)
        {
          views[piece][side] = static_cast<View>(most - counts.begin());
          any = true;
        }
      }
    }
    std::ranges::fill(votes, Votes{});
    return any;
  }

  const Crossings& crossings;
  const GridPlaces& grid;
  const Zones& zones;
  const std::vector<View>& ofZone;
  const SurfaceModel& model;
  const GridPart& part;
  const RunContext& context;
  std::vector<Index> pieceOf;
  std::vector<TriangleViews> views; ///< one per piece
  std::vector<Votes> votes;         ///< one per piece
};

} // namespace

std::vector<Index> piecesBetweenEdges(const SurfaceModel& model, Index& count, const Executor& executor)
{
  UnionFind sets(model.triangles.size());
  const std::vector<SoupEdgeUse> uses = sortedEdgeUses(model.triangles, model.points.size(), executor);
  eachEdge(uses, [&](std::span<const SoupEdgeUse> edge) {
    if (edge.size() != 2)
    {
      return;
    }
    const Index a = edge[0].triangle;
    const Index b = edge[1].triangle;
    if (model.domainSides[a] == model.domainSides[b] && model.kindOf(a) == model.kindOf(b) &&
        model.isTurnedSide(a) == model.isTurnedSide(b) && edge[0].forward != edge[1].forward)
    {
      sets.join(a, b);
    }
  });
  std::vector<Index> pieces(model.triangles.size());
  count = 0;
  for (Index t = 0; t < pieces.size(); ++t)
  {
    const Index root = sets.find(t);
    pieces[t] = root == t ? count++ : pieces[root];
  }
  return pieces;
}

std::vector<View> viewsOfZones(const std::vector<ZoneSummary>& zones)
{
  std::vector<View> views;
  std::ranges::transform(zones, std::back_inserter(views), [](const ZoneSummary& zone) {
    switch (zone.kind)
    {
      case ZoneKind::beyond:
        return View::beyond;
      case ZoneKind::open:
        return zone.kept ? View::air : View::ground;
      case ZoneKind::ground:
        return View::ground;
      case ZoneKind::room:
        return zone.kept ? View::air : View::room;
      case ZoneKind::narrow:
        return zone.kept ? View::air : View::narrow;
      default:
        return zone.kept ? View::air : View::solid;
    }
  });
  return views;
}

std::vector<TriangleViews> findModelViews(const Crossings& crossings, const GridPlaces& grid, const Zones& zones,
                                          const std::vector<View>& ofZone, const SurfaceModel& model,
                                          const GridPart& part, const RunContext& context)
{
  return ViewFinder(crossings, grid, zones, ofZone, model, part, context).run();
}

std::vector<float> findAirParts(const Crossings& crossings, const Zones& zones, const std::vector<View>& ofZone,
                                const SurfaceModel& model, const GridPart& part, const RunContext& context)
{
  constexpr std::uint32_t fewest = 3; // edges needed to decide
  constexpr float nearlyAll = 0.75F;  // an edge may cut two walls that meet
  std::vector<std::uint32_t> cut(model.triangles.size(), 0);
  std::vector<std::uint32_t> aired(model.triangles.size(), 0);
  const auto isAir = [&](Index point) { return viewAt(point, zones, ofZone) == View::air; };
  const auto count = [](std::vector<std::uint32_t>& counts, Index triangle) {
    std::atomic_ref(counts[triangle]).fetch_add(1, std::memory_order_relaxed);
  };
  context.executor.forEach(crossings.crossedEdges.size(), 2048, [&](std::size_t e) {
    const CrossedEdge& edge = crossings.crossedEdges[e];
    if (!part.owns(edge.point))
    {
      return;
    }
    const std::span<const SurfaceCrossing> cuts = crossings.of(edge);
    for (const SurfaceCrossing& one : cuts)
    {
      count(cut, one.triangle);
      const bool isFirst = &one == &cuts.front();
      const bool isLast = &one == &cuts.back();
      if ((isFirst && isAir(edge.point)) || (isLast && isAir(edge.other)))
      {
        count(aired, one.triangle);
      }
    }
  });
  cut = sumAll(part.exchange(), std::move(cut));
  aired = sumAll(part.exchange(), std::move(aired));
  std::vector<float> parts(cut.size(), 1.0F);
  for (std::size_t t = 0; t < parts.size(); ++t)
  {
    const float seen = cut[t] < fewest ? 1.0F : static_cast<float>(aired[t]) / static_cast<float>(cut[t]);
    parts[t] = seen < nearlyAll ? seen : 1.0F;
  }
  return parts;
}

} // namespace atria
