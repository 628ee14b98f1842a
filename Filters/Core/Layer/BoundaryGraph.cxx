// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/BoundaryGraph.h"

#include <algorithm>

namespace atria {

namespace {

constexpr std::size_t grain = 2048;

/// An edge of a face, kept at its lower point.
struct HalfEdge
{
  Index upper;
  Index code;
  bool rising;
};

/// Returns the faces of each point.
Buckets findFaces(const DualMesh& mesh, const RunContext& context)
{
  return fillInOrder(mesh.points.size(), context.executor, [&](auto&& use) {
    context.executor.forEach(mesh.boundaryFaces.size(), grain, [&](std::size_t f) {
      const ReducedFace face = faceOf(mesh.corners[mesh.boundaryFaces[f].element], mesh.boundaryFaces[f].direction);
      for (int i = 0; i < face.count; ++i)
      {
        use(face.points[i], static_cast<Index>(f));
      }
    });
  });
}

/// Sets `out` to the edges of the faces at a point that lead to higher points.
void collectEdges(const DualMesh& mesh, const BoundaryGraph& graph, Index point, std::vector<HalfEdge>& out)
{
  out.clear();
  for (const Index f : graph.facesAt(point))
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    for (int i = 0; i < 4; ++i)
    {
      const Index a = cornerOf(mesh, face, i);
      const Index b = cornerOf(mesh, face, i + 1);
      if (a != b && std::min(a, b) == point)
      {
        out.push_back({std::max(a, b), 4 * f + static_cast<Index>(i), a < b});
      }
    }
  }
  std::sort(out.begin(), out.end(), [](const HalfEdge& l, const HalfEdge& r) {
    return std::pair(l.upper, l.code) < std::pair(r.upper, r.code);
  });
}

} // namespace

BoundaryGraph findBoundaryGraph(const DualMesh& mesh, const RunContext& context)
{
  BoundaryGraph graph;
  graph.faces = findFaces(mesh, context);
  graph.across.assign(mesh.boundaryFaces.size(),
                      {BoundaryGraph::noEdge, BoundaryGraph::noEdge, BoundaryGraph::noEdge, BoundaryGraph::noEdge});
  const auto at = [&](Index code) -> Index& {
    return graph.across[BoundaryGraph::faceOf(code)][BoundaryGraph::edgeOf(code)];
  };
  // Each edge is written by its lower point alone.
  context.executor.forRanges(mesh.points.size(), grain, [&](std::size_t begin, std::size_t end) {
    context.progress.check();
    std::vector<HalfEdge> edges;
    for (auto p = static_cast<Index>(begin); p < end; ++p)
    {
      if (graph.facesAt(p).empty())
      {
        continue;
      }
      collectEdges(mesh, graph, p, edges);
      for (std::size_t i = 0, j = 0; i < edges.size(); i = j)
      {
        for (j = i; j < edges.size() && edges[j].upper == edges[i].upper; ++j)
        {
          at(edges[j].code) = BoundaryGraph::branching;
        }
        if (j == i + 2 && edges[i].rising != edges[i + 1].rising)
        {
          at(edges[i].code) = edges[i + 1].code;
          at(edges[i + 1].code) = edges[i].code;
        }
      }
    }
  });
  return graph;
}

std::vector<Index> fanAt(const DualMesh& mesh, const BoundaryGraph& graph, Index point)
{
  const auto star = graph.facesAt(point);
  std::vector<Index> fan;
  if (star.empty())
  {
    return fan;
  }
  Index at = star.front();
  do
  {
    fan.push_back(at);
    int leaving = -1;
    for (int i = 0; i < 4; ++i)
    {
      const BoundaryFace& face = mesh.boundaryFaces[at];
      leaving = cornerOf(mesh, face, i) == point && cornerOf(mesh, face, i + 1) != point ? i : leaving;
    }
    const Index code = leaving < 0 ? BoundaryGraph::branching : graph.across[at][leaving];
    if (!BoundaryGraph::isEdge(code) || fan.size() > star.size())
    {
      return {};
    }
    at = BoundaryGraph::faceOf(code);
  } while (at != star.front());
  return fan.size() == star.size() ? fan : std::vector<Index>();
}

} // namespace atria
