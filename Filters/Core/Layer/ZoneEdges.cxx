// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/ZoneEdges.h"

#include <map>
#include <optional>
#include <utility>

namespace atria {

namespace {

/// An edge of the boundary, given by the face, of its two, that runs along it from `from` to `to`.
struct DirectedEdge
{
  Index face;
  int edge;
};

std::optional<DirectedEdge> wallEdge(const DualMesh& mesh, const LayerWalls& walls, Index from, Index to)
{
  for (const Index f : walls.graph.facesAt(from))
  {
    const std::array<Index, 4> points = cornersOf(mesh, mesh.boundaryFaces[f]);
    for (int i = 0; i < 4; ++i)
    {
      const Index code = walls.graph.across[f][i];
      if (points[i] == from && points[(i + 1) & 3] == to && BoundaryGraph::isEdge(code) &&
          walls.roles[f] == FaceRole::wall && walls.roles[BoundaryGraph::faceOf(code)] == FaceRole::wall)
      {
        return DirectedEdge{f, i};
      }
    }
  }
  return std::nullopt;
}

} // namespace

std::vector<ZoneEdge> findZoneEdges(const DualMesh& mesh, const LayerWalls& walls)
{
  // Signed count of zone faces that end at an edge, seen from its lower face's element. The key is the lower
  // face-and-edge code of the edge's two, and the surface.
  std::map<std::pair<Index, Index>, int> fronts;
  for (const ZoneFace& zone : mesh.zoneFaces)
  {
    const ReducedFace face = faceOf(mesh.corners[zone.element], zone.direction);
    for (int i = 0; i < face.count; ++i)
    {
      // Successive faces around an edge, seen from inside an element, run along it in opposite directions.
      const Index from = face.points[i];
      const Index to = face.points[(i + 1) % face.count];
      if (const auto own = wallEdge(mesh, walls, to, from))
      {
        const Index code = 4 * own->face + static_cast<Index>(own->edge);
        const Index other = walls.graph.across[own->face][own->edge];
        const bool isFront = (zone.side == SheetSide::front) == (code < other);
        fronts[{std::min(code, other), zone.tag}] += isFront ? 1 : -1;
      }
    }
  }
  std::vector<ZoneEdge> edges;
  for (const auto& [at, sum] : fronts)
  {
    const Index face = BoundaryGraph::faceOf(at.first);
    const int edge = BoundaryGraph::edgeOf(at.first);
    const bool isNew = edges.empty() || edges.back().face != face || edges.back().edge != edge;
    if (sum != 0 && isNew)
    {
      edges.push_back({face, edge, at.second, sum > 0 ? SheetSide::front : SheetSide::back});
    }
  }
  return edges;
}

} // namespace atria
