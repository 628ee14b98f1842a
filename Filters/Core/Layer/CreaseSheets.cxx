// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/CreaseSheets.h"

#include "Layer/PrismAxes.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <functional>
#include <map>

namespace atria {

namespace {

/// Walls and the pieces they belong to. Corner k of a face comes after edge k - 1 and before edge k.
class PiecedWalls
{
public:
  PiecedWalls(const DualMesh& p, const LayerWalls& w, const std::vector<Index>& pieces)
      : plain(p), walls(w), pieceOf(pieces)
  {
  }

protected:
  Index pointAt(Index face, int k) const { return cornerOf(plain, plain.boundaryFaces[face], k); }
  Index across(Index face, int edge) const { return walls.graph.across[face][edge & 3]; }

  /// True if the face across the edge belongs to the same piece.
  bool isInner(Index face, int edge) const
  {
    const Index code = across(face, edge);
    return BoundaryGraph::isEdge(code) && pieceOf[BoundaryGraph::faceOf(code)] == pieceOf[face];
  }

  /// True if a wall of another piece is across the edge.
  bool isCrease(Index face, int edge) const
  {
    const Index code = across(face, edge);
    return BoundaryGraph::isEdge(code) && !isInner(face, edge) &&
           walls.roles[BoundaryGraph::faceOf(code)] == FaceRole::wall;
  }

  const DualMesh& plain;
  const LayerWalls& walls;
  const std::vector<Index>& pieceOf;
};

/// Marks the points of zone faces.
std::vector<char> zonePoints(const DualMesh& mesh)
{
  std::vector<char> marked(mesh.points.size(), 0);
  markZonePoints(mesh, marked);
  return marked;
}

/// True if face `f` is a wall with no face behind it, and the layer exists at all its corners. No corner may be `kept`,
/// and no edge may branch or end at a surface without layers.
bool isWhole(Index f, const LayerMesh& layer, const DualMesh& plain, const LayerWalls& walls,
             const std::vector<char>& kept)
{
  if (walls.roles[f] != FaceRole::wall || plain.boundaryFaces[f].opposite != noIndex)
  {
    return false;
  }
  for (int k = 0; k < 4; ++k)
  {
    const Index code = walls.graph.across[f][k];
    const Index p = cornerOf(plain, plain.boundaryFaces[f], k);
    if (layer.copies[p] == noIndex || kept[p] || !BoundaryGraph::isEdge(code) ||
        walls.roles[BoundaryGraph::faceOf(code)] == FaceRole::fixed)
    {
      return false;
    }
  }
  return true;
}

/// Numbers the pieces of whole walls by boundary face; returns how many there are.
Index findPieces(const LayerMesh& layer, const DualMesh& plain, const LayerWalls& walls, std::vector<Index>& pieceOf)
{
  pieceOf.assign(plain.boundaryFaces.size(), noIndex);
  std::map<std::array<Index, 3>, Index> pieces;
  const std::vector<char> kept = zonePoints(plain);
  for (Index f = 0; f < pieceOf.size(); ++f)
  {
    if (isWhole(f, layer, plain, walls, kept))
    {
      const BoundaryFace& face = plain.boundaryFaces[f];
      const std::array<Index, 3> key = face.chart == noIndex
                                           ? std::array<Index, 3>{noIndex, face.tag, face.direction}
                                           : std::array<Index, 3>{face.chart, static_cast<Index>(face.side), 0};
      pieceOf[f] = pieces.emplace(key, static_cast<Index>(pieces.size())).first->second;
    }
  }
  return static_cast<Index>(pieces.size());
}

class StepFinder : PiecedWalls
{
public:
  StepFinder(const LayerMesh& l, const DualMesh& p, const LayerWalls& w, const std::vector<Index>& pieces)
      : PiecedWalls(p, w, pieces), layer(l)
  {
  }

  /// Marks pieces with steps.
  std::vector<char> find(Index pieceCount) const
  {
    std::vector<char> marked(pieceCount, 0);
    for (Index f = 0; f < pieceOf.size(); ++f)
    {
      if (pieceOf[f] != noIndex)
      {
        marked[pieceOf[f]] |= hasStep(f) ? 1 : 0;
      }
    }
    return marked;
  }

private:
  /// True if two edges of a face are on creases and nearly in line.
  bool hasStep(Index f) const
  {
    for (int k = 0; k < 4; ++k)
    {
      if (isCrease(f, k) && isCrease(f, k + 3))
      {
        const Vec3& p = layer.mesh.points[pointAt(f, k)];
        const Vec3 before = (layer.mesh.points[pointAt(f, k + 3)] - p).normalized();
        const Vec3 after = (layer.mesh.points[pointAt(f, k + 1)] - p).normalized();
        if (before.dot(after) < inLineCosine)
        {
          return true;
        }
      }
    }
    return false;
  }

  const LayerMesh& layer;
};

/// Codes of corners and edges are 4 * face + k.
class CreaseSheetBuilder : PiecedWalls
{
public:
  CreaseSheetBuilder(LayerMesh& l, const DualMesh& p, const LayerWalls& w, const CreaseCharts& c, double relativeWidth)
      : PiecedWalls(p, w, c.pieceOf), layer(l), charts(c), width(relativeWidth), runs(4 * p.boundaryFaces.size())
  {
  }

  CreaseSheets build()
  {
    creaseSheets.firstPoint = static_cast<Index>(layer.mesh.points.size());
    creaseSheets.firstFace = static_cast<Index>(layer.mesh.boundaryFaces.size());
    joinRuns();
    splitPoints();
    numberElements();
    for (Index f = 0; f < plain.boundaryFaces.size(); ++f)
    {
      if (isParted(f))
      {
        addAbove(f);
      }
    }
    for (Index f = 0; f < plain.boundaryFaces.size(); ++f)
    {
      for (int i = 0; i < 4 && isParted(f); ++i)
      {
        if (isCrease(f, i))
        {
          addBeside(f, i);
        }
      }
    }
    return std::move(creaseSheets);
  }

private:
  /// Corners at one point that are connected through faces of a piece.
  struct Run
  {
    bool atCrease = false;
    /// The other end of an edge where the piece ends on a side of the domain.
    Index alongSide = noIndex;
    Vec3 beside = Vec3::Zero();
    int besideCount = 0;
  };

  static Index codeOf(Index face, int k) { return 4 * face + static_cast<Index>(k & 3); }
  bool isParted(Index face) const { return pieceOf[face] != noIndex && charts.isParted[pieceOf[face]]; }
  int directionOf(Index face) const { return plain.boundaryFaces[face].direction; }
  Index prismOf(Index face) const { return layer.mesh.boundaryFaces[face].element; }

  void joinRuns()
  {
    for (Index f = 0; f < plain.boundaryFaces.size(); ++f)
    {
      for (int i = 0; i < 4 && isParted(f); ++i)
      {
        if (isInner(f, i))
        {
          const Index code = across(f, i);
          const Index other = BoundaryGraph::faceOf(code);
          const int edge = BoundaryGraph::edgeOf(code);
          runs.join(codeOf(f, i), codeOf(other, edge + 1));
          runs.join(codeOf(f, i + 1), codeOf(other, edge));
        }
      }
    }
  }

  std::map<Index, Run> findRuns()
  {
    std::map<Index, Run> found;
    for (Index f = 0; f < plain.boundaryFaces.size(); ++f)
    {
      for (int k = 0; k < 4 && isParted(f); ++k)
      {
        Run& run = found[runs.find(codeOf(f, k))];
        for (const auto& [edge, end] : {std::pair(k, k + 1), std::pair(k + 3, k + 3)})
        {
          if (isInner(f, edge))
          {
            run.beside += layer.mesh.points[pointAt(f, end)];
            ++run.besideCount;
          }
          else if (isCrease(f, edge))
          {
            run.atCrease = true;
          }
          else
          {
            run.alongSide = pointAt(f, end);
          }
        }
      }
    }
    return found;
  }

  /// Adds a point halfway up the layer for each run, and one on the wall if the run ends at a crease.
  void splitPoints()
  {
    wallOf.assign(pieceOf.size() * 4, noIndex);
    insideOf.assign(pieceOf.size() * 4, noIndex);
    for (const auto& [root, run] : findRuns())
    {
      const Index f = root / 4;
      const auto k = static_cast<int>(root & 3);
      const Index p = pointAt(f, k);
      const Vec3 start = layer.mesh.points[p];
      const bool atSide = run.alongSide != noIndex;
      wallOf[root] = p;
      if (run.atCrease)
      {
        const Vec3 to = atSide                 ? layer.mesh.points[run.alongSide]
                        : run.besideCount == 0 ? layer.mesh.points[pointAt(f, k + 2)]
                                               : Vec3(run.beside / run.besideCount);
        wallOf[root] = addPoint(start + width * (to - start), {p, plain.boundaryFaces[f].chart, true, atSide});
      }
      insideOf[root] = addPoint(0.5 * (layer.mesh.points[wallOf[root]] + layer.mesh.points[layer.copies[p]]),
                                {p, noIndex, false, atSide});
    }
  }

  Index addPoint(const Vec3& place, const CreaseSheets::Point& what)
  {
    layer.mesh.points.push_back(place);
    creaseSheets.points.push_back(what);
    return static_cast<Index>(layer.mesh.points.size() - 1);
  }

  void numberElements()
  {
    above.assign(pieceOf.size(), noIndex);
    beside.assign(4 * pieceOf.size(), noIndex);
    auto next = static_cast<Index>(layer.mesh.elementCount());
    for (Index f = 0; f < above.size(); ++f)
    {
      above[f] = isParted(f) ? next++ : noIndex;
    }
    for (Index f = 0; f < above.size(); ++f)
    {
      for (int i = 0; i < 4 && isParted(f); ++i)
      {
        beside[codeOf(f, i)] = isCrease(f, i) ? next++ : noIndex;
      }
    }
  }

  void addElement(Index like, const std::array<Index, 8>& corners, const std::array<std::int32_t, 6>& neighbors)
  {
    appendElement(layer.mesh, corners, neighbors, layer.mesh, like);
  }

  /// Adds a boundary face like another one, for another element. Returns its neighbor code.
  std::int32_t addFace(Index like, Index element, int direction, Index wallFace)
  {
    BoundaryFace face = layer.mesh.boundaryFaces[like];
    face.element = element;
    face.direction = static_cast<std::uint8_t>(direction);
    layer.mesh.boundaryFaces.push_back(face);
    creaseSheets.wallFaces.push_back(wallFace);
    return ~static_cast<std::int32_t>(layer.mesh.boundaryFaces.size() - 1);
  }

  /// Returns the boundary face on which a prism ends across an edge of its wall, at a side of the domain.
  Index sideAt(Index f, int edge) const
  {
    return DualMesh::boundaryFaceOf(layer.mesh.neighbors[prismOf(f)][besideEdge(directionOf(f), edge)]);
  }

  /// Halves the prism of a face.
  void addAbove(Index f)
  {
    const int direction = directionOf(f);
    const int axis = axisOf(direction);
    const Index prism = prismOf(f);
    const Index inside = plain.boundaryFaces[f].element;
    std::array<Index, 8> corners;
    for (int k = 0; k < 4; ++k)
    {
      const std::uint8_t low = hexahedronFace[direction][k];
      const std::uint8_t high = acrossAxis(low, axis);
      const Index run = runs.find(codeOf(f, k));
      corners[high] = layer.mesh.corners[prism][high];
      corners[low] = insideOf[run];
      layer.mesh.corners[prism][high] = insideOf[run];
      layer.mesh.corners[prism][low] = wallOf[run];
    }
    std::array<std::int32_t, 6> neighbors;
    neighbors[direction] = static_cast<std::int32_t>(prism);
    neighbors[opposite(direction)] = static_cast<std::int32_t>(inside);
    for (int i = 0; i < 4; ++i)
    {
      const int lateral = besideEdge(direction, i);
      if (isInner(f, i))
      {
        neighbors[lateral] = static_cast<std::int32_t>(above[BoundaryGraph::faceOf(across(f, i))]);
      }
      else if (isCrease(f, i))
      {
        neighbors[lateral] = static_cast<std::int32_t>(beside[codeOf(f, i)]);
      }
      else
      {
        neighbors[lateral] = addFace(sideAt(f, i), above[f], lateral, noIndex);
      }
    }
    addElement(prism, corners, neighbors);
    layer.mesh.neighbors[prism][opposite(direction)] = static_cast<std::int32_t>(above[f]);
    layer.mesh.neighbors[inside][direction] = static_cast<std::int32_t>(above[f]);
  }

  /// Adds the element between the prism of a face and the crease.
  void addBeside(Index f, int edge)
  {
    const int direction = directionOf(f);
    const int lateral = besideEdge(direction, edge);
    const Index self = beside[codeOf(f, edge)];
    std::array<Index, 8> corners;
    for (const int k : {edge, (edge + 1) & 3})
    {
      const std::uint8_t low = hexahedronFace[direction][k];
      const std::uint8_t high = acrossAxis(low, axisOf(direction));
      const Index p = pointAt(f, k);
      const Index run = runs.find(codeOf(f, k));
      corners[low] = p;
      corners[high] = layer.copies[p];
      corners[acrossAxis(low, axisOf(lateral))] = wallOf[run];
      corners[acrossAxis(high, axisOf(lateral))] = insideOf[run];
    }
    std::array<std::int32_t, 6> neighbors;
    neighbors[direction] = addFace(f, self, direction, f);
    neighbors[opposite(direction)] = static_cast<std::int32_t>(above[f]);
    neighbors[opposite(lateral)] = static_cast<std::int32_t>(prismOf(f));
    neighbors[lateral] = beyond(f, edge, self);
    for (const int next : {(edge + 3) & 3, (edge + 1) & 3})
    {
      const int end = besideEdge(direction, next);
      neighbors[end] = atEnd(f, next, pointAt(f, next == ((edge + 1) & 3) ? next : edge), self, end);
    }
    addElement(prismOf(f), corners, neighbors);
    layer.mesh.neighbors[prismOf(f)][lateral] = static_cast<std::int32_t>(self);
  }

  /// Returns the element on the other side of the crease. A prism there gets `self` as its neighbor.
  std::int32_t beyond(Index f, int edge, Index self)
  {
    const Index code = across(f, edge);
    const Index other = BoundaryGraph::faceOf(code);
    if (isParted(other))
    {
      return static_cast<std::int32_t>(beside[code]);
    }
    layer.mesh.neighbors[prismOf(other)][besideEdge(directionOf(other), BoundaryGraph::edgeOf(code))] =
        static_cast<std::int32_t>(self);
    return static_cast<std::int32_t>(prismOf(other));
  }

  /// Returns the next element of the row around a point, starting at an edge of a face there. Adds a boundary face
  /// instead if the row ends on a side of the domain.
  std::int32_t atEnd(Index f, int edge, Index point, Index self, int end)
  {
    while (isInner(f, edge))
    {
      const Index code = across(f, edge);
      f = BoundaryGraph::faceOf(code);
      edge = BoundaryGraph::edgeOf(code);
      edge = (pointAt(f, edge) == point ? edge + 3 : edge + 1) & 3;
    }
    return isCrease(f, edge) ? static_cast<std::int32_t>(beside[codeOf(f, edge)])
                             : addFace(sideAt(f, edge), self, end, noIndex);
  }

  LayerMesh& layer;
  const CreaseCharts& charts;
  double width;
  UnionFind runs;
  /// Points on the wall and inside the layer; the entry of a run is at its root.
  std::vector<Index> wallOf;
  std::vector<Index> insideOf;
  /// Elements: upper halves, one entry per face, and elements beside creases, one entry per edge.
  std::vector<Index> above;
  std::vector<Index> beside;
  CreaseSheets creaseSheets;
};

} // namespace

CreaseCharts findCreaseCharts(const LayerMesh& layer, const DualMesh& plain, const LayerWalls& walls)
{
  CreaseCharts charts;
  const Index count = findPieces(layer, plain, walls, charts.pieceOf);
  charts.isParted = StepFinder(layer, plain, walls, charts.pieceOf).find(count);
  return charts;
}

CreaseSheets insertCreaseSheets(LayerMesh& layer, const DualMesh& plain, const LayerWalls& walls,
                                const CreaseCharts& charts, double width)
{
  return CreaseSheetBuilder(layer, plain, walls, charts, width).build();
}

} // namespace atria
