// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Grid/Crossings.h"

#include <algorithm>
#include <functional>
#include <numeric>

namespace atria {

namespace {

/// Crossings of a range of grid points, joined with those of other ranges afterwards.
struct Part
{
  std::vector<BoundaryFace> faces;
  std::vector<CrossedEdge> edges;
  std::vector<SurfaceCrossing> cuts;
};

class CrossingFinder
{
public:
  CrossingFinder(const GridPlaces& places, const SurfaceModel& surfaces, Crossings& target)
      : grid(places), model(surfaces), out(target), probe(places.octree(), surfaces)
  {
  }

  /// Sets the neighbors of one point. Edges between two points are cut from their lower end.
  void process(Index point, Part& part)
  {
    const std::array<GridPlaces::Edge, 6> edges = grid.edges(point);
    for (int direction = 0; direction < 6; ++direction)
    {
      const GridPlaces::Edge& edge = edges[direction];
      std::int32_t& neighbor = out.neighbors[point][direction];
      if (!edge.exists())
      {
        neighbor = DualMesh::noFace;
        continue;
      }
      neighbor = static_cast<std::int32_t>(edge.other);
      const bool occupied = !grid.octree().items(edge.at.leaf).empty() || grid.isDisplaced(point, edge);
      const bool leaves = edge.other == noIndex;
      if (leaves || (occupied && isUpper(direction)))
      {
        const EdgeSegment segment = grid.segment(point, direction, edge);
        const auto cuts = cutEdge(grid, probe, point, edge, segment);
        record(point, edge.other, direction, segment, cuts, part);
        leaves ? leave(point, direction, edge, segment, cuts, part) : cutBetween(point, direction, edge, cuts, part);
      }
    }
  }

private:
  /// Adds the face on an edge that leads out of the domain: on its first wall, or else on the domain's side.
  void leave(Index point, int direction, const GridPlaces::Edge& edge, const EdgeSegment& segment,
             std::span<const SurfaceCrossing> cuts, Part& part)
  {
    const auto walls = [&](const SurfaceCrossing& cut) { return isWall(cut); };
    if (const auto first = std::ranges::find_if(cuts, walls); first != cuts.end())
    {
      part.faces.push_back({point, model.surfaceIds[first->triangle], noIndex, static_cast<std::uint8_t>(direction),
                            seenFromStart(*first), false, model.charts[first->triangle]});
      return;
    }
    const Index triangle = probe.sideTriangle(edge.at.leaf, segment.end, direction);
    const Index tag =
        triangle == noIndex ? static_cast<Index>(model.names.size()) + direction : model.surfaceIds[triangle];
    part.faces.push_back({point, tag, noIndex, static_cast<std::uint8_t>(direction), SheetSide::front, true});
  }

  void cutBetween(Index point, int direction, const GridPlaces::Edge& edge, std::span<const SurfaceCrossing> cuts,
                  Part& part)
  {
    const auto walls = [&](const SurfaceCrossing& cut) { return isWall(cut); };
    const auto first = std::ranges::find_if(cuts, walls);
    if (first == cuts.end())
    {
      return;
    }
    const SurfaceCrossing& last = *std::find_if(cuts.rbegin(), cuts.rend(), walls);
    part.faces.push_back({point, model.surfaceIds[first->triangle], edge.other, static_cast<std::uint8_t>(direction),
                          seenFromStart(*first), false, model.charts[first->triangle]});
    part.faces.push_back({edge.other, model.surfaceIds[last.triangle], point,
                          static_cast<std::uint8_t>(opposite(direction)), seenFromEnd(last), false,
                          model.charts[last.triangle]});
  }

  bool isWall(const SurfaceCrossing& cut) const { return !model.isPermeable(cut.triangle); }

  static void record(Index point, Index other, int direction, const EdgeSegment& segment,
                     std::span<const SurfaceCrossing> cuts, Part& part)
  {
    if (cuts.empty())
    {
      return;
    }
    part.edges.push_back({point, other, static_cast<std::uint8_t>(direction), segment,
                          static_cast<std::uint32_t>(part.cuts.size()), static_cast<std::uint32_t>(cuts.size())});
    part.cuts.insert(part.cuts.end(), cuts.begin(), cuts.end());
  }

  const GridPlaces& grid;
  const SurfaceModel& model;
  Crossings& out;
  EdgeProbe probe;
};

/// Finds the crossings of the points pointAt(0) to pointAt(count - 1), in one part for each `grain` of them. Writes
/// their neighbors to `out`.
template <typename PointAt>
std::vector<Part> findParts(const GridPlaces& grid, const SurfaceModel& model, std::size_t count, std::size_t grain,
                            PointAt&& pointAt, Crossings& out, const RunContext& context)
{
  std::vector<Part> parts((count + grain - 1) / grain);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    context.progress.check();
    CrossingFinder finder(grid, model, out);
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, count); ++i)
    {
      finder.process(pointAt(i), parts[part]);
    }
  });
  return parts;
}

void join(const std::vector<Part>& parts, Crossings& out)
{
  const auto total = [&](auto list) {
    return std::transform_reduce(parts.begin(), parts.end(), std::size_t{0}, std::plus<>(),
                                 [&](const Part& part) { return (part.*list).size(); });
  };
  out.boundaryFaces.reserve(total(&Part::faces));
  out.crossedEdges.reserve(total(&Part::edges));
  out.cuts.reserve(total(&Part::cuts));
  for (const Part& part : parts)
  {
    const auto shift = static_cast<std::uint32_t>(out.cuts.size());
    out.boundaryFaces.insert(out.boundaryFaces.end(), part.faces.begin(), part.faces.end());
    out.cuts.insert(out.cuts.end(), part.cuts.begin(), part.cuts.end());
    for (CrossedEdge edge : part.edges)
    {
      edge.begin += shift;
      out.crossedEdges.push_back(edge);
    }
  }
}

void numberFaces(Crossings& out)
{
  for (std::size_t f = 0; f < out.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = out.boundaryFaces[f];
    out.neighbors[face.element][face.direction] = ~static_cast<std::int32_t>(f);
  }
}

/// Returns these points and those at the other ends of their edges; sorted.
std::vector<Index> withNeighbors(const GridPlaces& grid, const std::vector<Index>& points)
{
  std::vector<Index> all = points;
  for (const Index point : points)
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      const GridPlaces::Edge edge = grid.edge(point, direction);
      if (edge.exists() && edge.other != noIndex)
      {
        all.push_back(edge.other);
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Returns the point whose edges a face was found with.
Index finderOf(const BoundaryFace& face)
{
  return face.opposite == noIndex || isUpper(face.direction) ? face.element : face.opposite;
}

/// Copies crossings that were found before, point by point.
class Remaining
{
public:
  explicit Remaining(const Crossings& found) : before(found) {}

  void appendBelow(Index end, Part& to)
  {
    for (; face < before.boundaryFaces.size() && finderOf(before.boundaryFaces[face]) < end; ++face)
    {
      to.faces.push_back(before.boundaryFaces[face]);
    }
    for (; edge < before.crossedEdges.size() && before.crossedEdges[edge].point < end; ++edge)
    {
      const auto cuts = before.of(before.crossedEdges[edge]);
      to.edges.push_back(before.crossedEdges[edge]);
      to.edges.back().begin = static_cast<std::uint32_t>(to.cuts.size());
      to.cuts.insert(to.cuts.end(), cuts.begin(), cuts.end());
    }
  }

  void skip(Index point)
  {
    while (face < before.boundaryFaces.size() && finderOf(before.boundaryFaces[face]) == point)
    {
      ++face;
    }
    while (edge < before.crossedEdges.size() && before.crossedEdges[edge].point == point)
    {
      ++edge;
    }
  }

private:
  const Crossings& before;
  std::size_t face = 0;
  std::size_t edge = 0;
};

} // namespace

Buckets edgesByLeaf(const Crossings& crossings, std::size_t leafCount, const RunContext& context)
{
  return fillInOrder(leafCount, context.executor, [&](auto&& use) {
    context.executor.forEach(crossings.crossedEdges.size(), 2048, [&](std::size_t e) {
      eachLeaf(crossings.crossedEdges[e].segment.about, [&](Index leaf) { use(leaf, static_cast<Index>(e)); });
    });
  });
}

std::span<const SurfaceCrossing> cutEdge(const GridPlaces& grid, EdgeProbe& probe, Index point,
                                         const GridPlaces::Edge& edge, const EdgeSegment& segment,
                                         const GridTrial& trial)
{
  return grid.isDisplaced(point, edge, trial) ? probe.cut(segment, grid.leavesNear(point, edge))
                                              : probe.cut(segment, std::span(&edge.at.leaf, 1));
}

Crossings findCrossings(const GridPlaces& grid, const SurfaceModel& model, const RunContext& context)
{
  constexpr std::size_t grain = 2048;
  Crossings out;
  const std::size_t count = grid.points().size();
  out.neighbors.resize(count);
  const auto same = [](std::size_t i) { return static_cast<Index>(i); };
  join(findParts(grid, model, count, grain, same, out, context), out);
  numberFaces(out);
  return out;
}

Crossings updateCrossings(const GridPlaces& grid, const SurfaceModel& model, Crossings before,
                          const std::vector<Index>& changed, const RunContext& context)
{
  constexpr std::size_t grain = 16;
  Crossings out;
  out.neighbors = std::move(before.neighbors);
  const std::vector<Index> points = withNeighbors(grid, changed);
  const auto pointAt = [&](std::size_t i) { return points[i]; };
  Crossings anew;
  join(findParts(grid, model, points.size(), grain, pointAt, out, context), anew);
  Remaining remaining(before);
  Remaining found(anew);
  Part all;
  all.faces.reserve(before.boundaryFaces.size() + anew.boundaryFaces.size());
  all.edges.reserve(before.crossedEdges.size() + anew.crossedEdges.size());
  all.cuts.reserve(before.cuts.size() + anew.cuts.size());
  for (const Index point : points)
  {
    remaining.appendBelow(point, all);
    remaining.skip(point);
    found.appendBelow(point + 1, all);
  }
  remaining.appendBelow(noIndex, all);
  out.boundaryFaces = std::move(all.faces);
  out.crossedEdges = std::move(all.edges);
  out.cuts = std::move(all.cuts);
  numberFaces(out);
  return out;
}

} // namespace atria
