// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Zones/CrackClosing.h"

#include "Dual/Zones/CrackStrips.h"
#include "Octree/Tree/GeometryLists.h"

#include <algorithm>
#include <tuple>

namespace atria {

namespace {

/// An edge of the grid that passes through a strip.
struct Passage
{
  Index point;
  std::uint8_t direction;
  SurfaceCrossing cut;

  std::pair<Index, std::uint8_t> edge() const { return {point, direction}; }
  bool operator<(const Passage& other) const
  {
    return std::tie(point, direction, cut.parameter, cut.triangle, cut.orientation) <
           std::tie(other.point, other.direction, other.cut.parameter, other.cut.triangle, other.cut.orientation);
  }
};

class PassageFinder
{
public:
  PassageFinder(const Crossings& found, const GridPlaces& places) : crossings(found), grid(places) {}

  void look(const StripTriangle& strip, std::vector<Passage>& out)
  {
    gatherEdges(strip);
    for (const auto& [point, direction] : edges)
    {
      const EdgeSegment segment = grid.segment(point, direction, grid.edge(point, direction));
      const auto& [a, b, c] = strip.corners;
      if (const auto cut = crossingOf(segment, a, b, c, strip.boundaryEdge))
      {
        out.push_back({point, static_cast<std::uint8_t>(direction), *cut});
      }
    }
  }

private:
  /// Uncut edges of the leaves about a strip, each from its lower end.
  void gatherEdges(const StripTriangle& strip)
  {
    const auto& [a, b, c] = strip.corners;
    LatticeBox box{a, a};
    // Edges with an end that was moved lie off their leaves, by up to an octant.
    const Octree& octree = grid.octree();
    const GridFrame& frame = octree.frame();
    const std::int64_t margin =
        grid.displacedCount() == 0 || !frame.inDomain(a) ? 0 : frame.latticeSize(octree.level(octree.leafAt(a)));
    for (int axis = 0; axis < 3; ++axis)
    {
      box.low[axis] = std::min({a[axis], b[axis], c[axis]}) - margin;
      box.high[axis] = std::max({a[axis], b[axis], c[axis]}) + margin;
    }
    edges.clear();
    for (const Index leaf : leavesTouching(octree, box))
    {
      for (const Index point : grid.points().atCorner[leaf])
      {
        for (int direction = 0; point != noIndex && direction < 6; ++direction)
        {
          if (isUncut(point, direction))
          {
            edges.emplace_back(point, direction);
          }
        }
      }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  }

  bool isUncut(Index point, int direction) const
  {
    const std::int32_t code = crossings.neighbors[point][direction];
    return code >= 0
               ? isUpper(direction)
               : DualMesh::isBoundary(code) && crossings.boundaryFaces[DualMesh::boundaryFaceOf(code)].onDomainSide;
  }

  const Crossings& crossings;
  const GridPlaces& grid;
  std::vector<std::pair<Index, int>> edges;
};

/// Puts the cut of an edge on record, as findCrossings does.
void cut(Crossings& crossings, const GridPlaces& grid, const SurfaceModel& model, const Passage& passage)
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

} // namespace

Crossings closeCracks(Crossings crossings, const GridPlaces& grid, double tolerance, const MeshingContext& context)
{
  if (!(tolerance > 0.0))
  {
    return crossings;
  }
  const std::vector<StripTriangle> strips = crackStrips(tolerance, context);
  constexpr std::size_t grain = 256;
  std::vector<std::vector<Passage>> found((strips.size() + grain - 1) / grain);
  context.executor.forEach(found.size(), 1, [&](std::size_t part) {
    context.progress.check();
    PassageFinder finder(crossings, grid);
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, strips.size()); ++i)
    {
      finder.look(strips[i], found[part]);
    }
  });
  std::vector<Passage> passages;
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
