// SPDX-License-Identifier: GPL-3.0-or-later
#include "Mesher/Improvement/CurveJogs.h"

#include "Support/Sorting.h"

#include <algorithm>

namespace atria {

namespace {

class JogRemover
{
public:
  JogRemover(DualMesh& m, const BoundaryGraph& g, const std::vector<Index>& vertices, VertexClassification& a)
      : mesh(m), graph(g), vertexOf(vertices), classification(a)
  {
  }

  RemovedJogs run()
  {
    RemovedJogs out;
    // A jog may have another beside it. Each makes the curve shorter by two edges, so this ends.
    for (bool isDone = false; !isDone;)
    {
      isDone = true;
      for (Index f = 0; f < mesh.boundaryFaces.size(); ++f)
      {
        if (const int inner = innerEdge(f); inner >= 0 && isJog(f, inner) && canJoin(f, inner))
        {
          join(f, inner, out.freed);
          ++out.faces;
          isDone = false;
        }
      }
    }
    return out;
  }

private:
  Index pointAt(Index f, int k) const { return cornerOf(mesh, mesh.boundaryFaces[f], k); }
  Index vertexAt(Index f, int k) const { return vertexOf[pointAt(f, k)]; }
  Index behind(Index f) const { return faceBehind(mesh, mesh.boundaryFaces[f]); }
  const BoundaryFace& across(Index f, int k) const
  {
    return mesh.boundaryFaces[BoundaryGraph::faceOf(graph.across[f][k & 3])];
  }
  static bool isOfSameSurface(const BoundaryFace& a, const BoundaryFace& b)
  {
    return a.chart == b.chart && a.side == b.side && a.tag == b.tag;
  }

  /// Returns the edge with a face of the same chart across it, if faces of another chart are across all others; else
  /// -1.
  int innerEdge(Index f) const
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    if (face.chart == noIndex || face.onDomainSide || !std::ranges::all_of(graph.across[f], &BoundaryGraph::isEdge))
    {
      return -1;
    }
    int inner = -1;
    for (int k = 0; k < 4; ++k)
    {
      inner = across(f, k).chart == face.chart ? k : inner;
    }
    const auto isBeyond = [&](int k) {
      const BoundaryFace& other = across(f, k);
      return other.chart != face.chart && other.chart != noIndex && !other.onDomainSide &&
             isOfSameSurface(other, across(f, inner + 2)) && (other.opposite == noIndex) == (face.opposite == noIndex);
    };
    return inner >= 0 && isBeyond(inner + 1) && isBeyond(inner + 2) && isBeyond(inner + 3) ? inner : -1;
  }

  /// True if both points between edges on the curve are on one curve, and the edges are in line at one of them.
  bool isJog(Index f, int inner) const
  {
    const Index first = vertexAt(f, inner + 2);
    const Index second = vertexAt(f, inner + 3);
    if (classification.classes[first] != VertexClass::curve || classification.classes[second] != VertexClass::curve ||
        !std::ranges::equal(classification.piecesOf(first), classification.piecesOf(second)))
    {
      return false;
    }
    return isStraight(f, inner + 2) || isStraight(f, inner + 3);
  }

  /// True if the other side of a sheet has the same jog.
  bool canJoin(Index f, int inner) const
  {
    if (mesh.boundaryFaces[f].opposite == noIndex)
    {
      return true;
    }
    const Index other = behind(f);
    const int there = other == noIndex ? -1 : innerEdge(other);
    return there >= 0 && across(other, there + 2).chart == across(f, inner + 2).chart &&
           std::minmax(vertexAt(f, inner), vertexAt(f, inner + 1)) ==
               std::minmax(vertexAt(other, there), vertexAt(other, there + 1));
  }

  bool isStraight(Index f, int k) const
  {
    const Vec3& p = mesh.points[pointAt(f, k)];
    const Vec3 before = (mesh.points[pointAt(f, k + 3)] - p).normalized();
    const Vec3 after = (mesh.points[pointAt(f, k + 1)] - p).normalized();
    return before.dot(after) < inLineCosine;
  }

  void join(Index f, int inner, std::vector<Index>& freed)
  {
    const Index other = behind(f);
    if (other != noIndex)
    {
      become(other, across(other, innerEdge(other) + 2));
    }
    become(f, across(f, inner + 2));
    for (const int k : {inner + 2, inner + 3})
    {
      free(f, other, vertexAt(f, k), freed);
    }
  }

  void become(Index f, const BoundaryFace& like)
  {
    BoundaryFace& face = mesh.boundaryFaces[f];
    face.chart = like.chart;
    face.side = like.side;
    face.tag = like.tag;
  }

  /// Frees a vertex of a face from its curve, if all its points are points of the face or of the one behind it, and
  /// within its chart.
  void free(Index f, Index other, Index vertex, std::vector<Index>& freed)
  {
    std::vector<Index> points;
    for (const Index face : {f, other})
    {
      for (int k = 0; k < 4 && face != noIndex; ++k)
      {
        if (vertexAt(face, k) == vertex && isWithin(pointAt(face, k), mesh.boundaryFaces[f].chart))
        {
          points.push_back(pointAt(face, k));
        }
      }
    }
    sortUnique(points);
    if (points.size() == pointsOf(vertex))
    {
      classification.classes[vertex] = VertexClass::surface;
      std::fill(classification.pieces.begin() + classification.offsets[vertex],
                classification.pieces.begin() + classification.offsets[vertex + 1], mesh.boundaryFaces[f].chart);
      freed.insert(freed.end(), points.begin(), points.end());
    }
  }

  /// Returns the number of points of a vertex. Counts at the first call, as most meshes have no jog.
  Index pointsOf(Index vertex)
  {
    if (pointCounts.empty())
    {
      pointCounts.resize(classification.classes.size(), 0);
      for (const Index v : vertexOf)
      {
        ++pointCounts[v];
      }
    }
    return pointCounts[vertex];
  }

  bool isWithin(Index point, Index chart) const
  {
    return std::ranges::all_of(graph.facesAt(point), [&](Index f) { return mesh.boundaryFaces[f].chart == chart; });
  }

  DualMesh& mesh;
  const BoundaryGraph& graph;
  const std::vector<Index>& vertexOf;
  VertexClassification& classification;
  std::vector<Index> pointCounts;
};

} // namespace

RemovedJogs removeJogs(DualMesh& mesh, const BoundaryGraph& graph, const std::vector<Index>& vertexOf,
                       VertexClassification& classification)
{
  return JogRemover(mesh, graph, vertexOf, classification).run();
}

} // namespace atria
