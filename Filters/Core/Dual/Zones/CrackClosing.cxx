// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/CrackClosing.h"

#include "Octree/Tree/GeometryLists.h"
#include "Support/Sorting.h"

#include <algorithm>

namespace atria {

namespace {

/// Whether the edge from its lower end, or to an end of the domain, is one that nothing cuts.
bool isUncut(Index point, int direction, const Crossings& crossings)
{
  const std::int32_t code = crossings.neighbors[point][direction];
  return code >= 0 ? isUpper(direction)
                   : DualMesh::isBoundary(code) && crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)].onDomainSide;
}

/// Grid points of the leaves about a bridge.
std::vector<Index> pointsAbout(const BridgeTriangle& bridge, const GridPlaces& grid)
{
  const auto& [a, b, c] = bridge;
  const Octree& octree = grid.octree();
  const GridFrame& frame = octree.frame();
  // Edges with an end that was moved lie off their leaves, by up to an octant.
  const std::int64_t margin =
      grid.displacedCount() == 0 || !frame.inDomain(a) ? 0 : frame.latticeSize(octree.level(octree.leafAt(a)));
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.low[axis] = std::min({a[axis], b[axis], c[axis]}) - margin;
    box.high[axis] = std::max({a[axis], b[axis], c[axis]}) + margin;
  }
  std::vector<Index> points;
  for (const Index leaf : leavesTouching(octree, box))
  {
    const auto& corners = grid.points().atCorner[leaf];
    std::ranges::copy_if(corners, std::back_inserter(points), [](Index point) { return point != noIndex; });
  }
  sortUnique(points);
  return points;
}

/// Puts the cut of an edge on record, as findCrossings does.
void cut(Crossings& crossings, const GridPlaces& grid, const SurfaceModel& model, const PassingEdge& passage)
{
  const GridPlaces::Edge edge = grid.edge(passage.point, passage.direction);
  crossings.crossedEdges.push_back({passage.point, edge.other, passage.direction,
                                    grid.segment(passage.point, passage.direction, edge),
                                    static_cast<std::uint32_t>(crossings.cuts.size()), 1});
  crossings.cuts.push_back(passage.cut);
  const Index tag = model.surfaceIds[passage.cut.triangle];
  const Index chart = model.charts[passage.cut.triangle];
  std::int32_t& code = crossings.neighbors[passage.point][passage.direction];
  if (edge.other == noIndex)
  {
    BoundaryFace& face = crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)];
    face = {passage.point, tag, noIndex, passage.direction, seenFromStart(passage.cut), false, chart};
    return;
  }
  const auto add = [&](const BoundaryFace& face) {
    crossings.neighbors[face.element][face.direction] = ~static_cast<std::int32_t>(crossings.boundaryFaces.size());
    crossings.boundaryFaces.push_back(face);
  };
  add({passage.point, tag, edge.other, passage.direction, seenFromStart(passage.cut), false, chart});
  add({edge.other, tag, passage.point, static_cast<std::uint8_t>(opposite(passage.direction)), seenFromEnd(passage.cut),
       false, chart});
}

/// The passages of an edge's bridges, and of those to the next edge at its ends.
std::vector<PassingEdge> passingEdgesOf(Index edge, const BoundaryGaps& gaps, const Crossings& crossings,
                                        const GridPlaces& grid, double tolerance, const SurfaceModel& model)
{
  const Index triangle = gaps.boundary.edges()[edge].triangle;
  std::vector<PassingEdge> found;
  const auto look = [&](const std::vector<BridgeTriangle>& bridges) {
    for (const BridgeTriangle& bridge : bridges)
    {
      const std::vector<PassingEdge> passages = passingEdgesOf(bridge, triangle, crossings, grid);
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

} // namespace

std::vector<PassingEdge> passingEdgesOf(const BridgeTriangle& bridge, Index triangle, const Crossings& crossings,
                                        const GridPlaces& grid)
{
  std::vector<PassingEdge> passages;
  for (const Index point : pointsAbout(bridge, grid))
  {
    for (int direction = 0; direction < 6; ++direction)
    {
      if (!isUncut(point, direction, crossings))
      {
        continue;
      }
      const EdgeSegment segment = grid.segment(point, direction, grid.edge(point, direction));
      if (const auto cut = crossingOf(segment, bridge[0], bridge[1], bridge[2], triangle))
      {
        passages.push_back({point, static_cast<std::uint8_t>(direction), *cut});
      }
    }
  }
  return passages;
}

Crossings closeCracks(Crossings crossings, const BoundaryGaps& gaps, const GridPlaces& grid, double tolerance,
                      const MeshingContext& context)
{
  if (!(tolerance > 0.0))
  {
    return crossings;
  }
  std::vector<std::vector<PassingEdge>> found(gaps.stations.size());
  context.executor.forEach(found.size(), 16, [&](std::size_t edge) {
    context.progress.check();
    if (!gaps.stations[edge].empty())
    {
      found[edge] = passingEdgesOf(static_cast<Index>(edge), gaps, crossings, grid, tolerance, context.model);
    }
  });
  std::vector<PassingEdge> passages;
  for (const auto& part : found)
  {
    passages.insert(passages.end(), part.begin(), part.end());
  }
  std::sort(passages.begin(), passages.end());
  for (std::size_t i = 0; i < passages.size(); ++i)
  {
    if (i == 0 || passages[i].edge() != passages[i - 1].edge())
    {
      cut(crossings, grid, context.model, passages[i]);
    }
  }
  return crossings;
}

} // namespace atria
