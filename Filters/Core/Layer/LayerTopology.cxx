// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerTopology.h"

#include "Layer/PrismAxes.h"
#include "Layer/ZoneEdges.h"

#include <algorithm>

namespace atria {

namespace {

/// Adds to the lists of the plain mesh, which are copied or taken over. Elements keep their plain corners until all
/// prisms are there.
class Builder
{
public:
  Builder(const DualMesh& p, const LayerWalls& w, const std::vector<Index>& c, const Executor& e)
      : plain(p), walls(w), counts(c), executor(e)
  {
    out.plainPoints = static_cast<Index>(plain.points.size());
    out.plainElements = static_cast<Index>(plain.elementCount());
    numberPoints();
    countPrisms();
    sideCount = countSides();
    zoneEdges = plain.zoneFaces.empty() ? std::vector<ZoneEdge>() : findZoneEdges(plain, walls);
  }

  LayerMesh copyAndBuild()
  {
    forLists(plain, [this](const auto& from, auto& to, std::size_t room) {
      to.reserve(room);
      to.resize(from.size());
      executor.forRanges(from.size(), 16384, [&](std::size_t begin, std::size_t end) {
        std::copy(from.begin() + static_cast<std::ptrdiff_t>(begin), from.begin() + static_cast<std::ptrdiff_t>(end),
                  to.begin() + static_cast<std::ptrdiff_t>(begin));
      });
    });
    out.mesh.zoneFaces = plain.zoneFaces;
    return build();
  }

  LayerMesh takeAndBuild(DualMesh& given)
  {
    forLists(given, [](auto& from, auto& to, std::size_t room) {
      to = std::move(from);
      to.reserve(room);
    });
    out.mesh.zoneFaces = std::move(given.zoneFaces);
    return build();
  }

private:
  Index stackOf(Index face) const { return firstPrism[face + 1] - firstPrism[face]; }
  Index prismAt(Index face, Index height) const { return out.plainElements + firstPrism[face] + height; }

  /// Returns a point of a chain; the last one beyond its end.
  Index chainPoint(Index point, Index place) const
  {
    const Index reached = std::min(place, counts[point]);
    return reached == 0 ? point : firstNew[point] + reached - 1;
  }

  void numberPoints()
  {
    out.copies.assign(out.plainPoints, noIndex);
    firstNew.assign(out.plainPoints, noIndex);
    for (Index p = 0; p < out.plainPoints; ++p)
    {
      if (counts[p] > 0)
      {
        firstNew[p] = out.plainPoints + static_cast<Index>(out.wallPoints.size());
        out.wallPoints.insert(out.wallPoints.end(), counts[p], p);
        for (Index place = 1; place <= counts[p]; ++place)
        {
          out.places.push_back(place);
        }
        out.copies[p] = chainPoint(p, counts[p]);
      }
    }
  }

  void countPrisms()
  {
    firstPrism.assign(plain.boundaryFaces.size() + 1, 0);
    for (Index f = 0; f < plain.boundaryFaces.size(); ++f)
    {
      Index most = 0;
      for (int i = 0; i < 4 && walls.roles[f] == FaceRole::wall; ++i)
      {
        most = std::max(most, counts[cornerOf(plain, plain.boundaryFaces[f], i)]);
      }
      firstPrism[f + 1] = firstPrism[f] + most;
    }
  }

  /// Calls `each` with each list of points or elements of a mesh, the list it becomes, and the number of entries that
  /// this will have.
  template <typename Mesh, typename Each> void forLists(Mesh& from, Each&& each)
  {
    DualMesh& to = out.mesh;
    const auto ofElements = [&](auto& list, auto& become) {
      each(list, become, list.empty() ? 0 : out.plainElements + firstPrism.back());
    };
    each(from.points, to.points, out.plainPoints + out.wallPoints.size());
    ofElements(from.corners, to.corners);
    ofElements(from.levels, to.levels);
    ofElements(from.zones, to.zones);
    ofElements(from.rooms, to.rooms);
    ofElements(from.cellZones, to.cellZones);
  }

  LayerMesh build()
  {
    addPoints();
    addNeighbors();
    for (Index f = 0; f < plain.boundaryFaces.size(); ++f)
    {
      for (Index height = 0; height < stackOf(f); ++height)
      {
        addPrism(f, height);
      }
    }
    for (Index f = 0; f < plain.boundaryFaces.size(); ++f)
    {
      moveBoundary(f);
    }
    extendZones();
    moveToCopies();
    return std::move(out);
  }

  void addPoints()
  {
    std::vector<Vec3>& points = out.mesh.points;
    points.resize(out.plainPoints + out.wallPoints.size());
    executor.forEach(out.wallPoints.size(), 16384,
                     [&](std::size_t i) { points[out.plainPoints + i] = points[out.wallPoints[i]]; });
  }

  void addNeighbors()
  {
    out.mesh.neighbors.reserve(out.plainElements + firstPrism.back());
    out.mesh.neighbors.resize(out.plainElements);
    executor.forEach(out.plainElements, 16384, [&](std::size_t e) { out.mesh.neighbors[e] = plain.neighbors[e]; });
    out.mesh.boundaryFaces.reserve(plain.boundaryFaces.size() + sideCount);
    out.mesh.boundaryFaces = plain.boundaryFaces;
    out.wallFaces.reserve(firstPrism.back());
    out.heights.reserve(firstPrism.back());
  }

  /// Sets the corners of elements of the plain mesh.
  void moveToCopies()
  {
    executor.forEach(out.wallPoints.empty() ? 0 : out.plainElements, 16384, [&](std::size_t e) {
      for (Index& p : out.mesh.corners[e])
      {
        p = out.copies[p] == noIndex ? p : out.copies[p];
      }
    });
  }

  /// Counts the boundary faces beside prisms.
  std::size_t countSides() const
  {
    std::size_t count = 0;
    for (Index f = 0; f < plain.boundaryFaces.size(); ++f)
    {
      for (int edge = 0; edge < 4 && stackOf(f) > 0; ++edge)
      {
        count += isSide(walls.graph.across[f][edge]) ? highestAt(plain, f, edge) : 0;
      }
    }
    return count;
  }

  bool isSide(Index code) const
  {
    return BoundaryGraph::isEdge(code) && walls.roles[BoundaryGraph::faceOf(code)] != FaceRole::wall;
  }

  /// Returns the number of prisms on a wall face that reach one of its edges.
  Index highestAt(const DualMesh& mesh, Index f, int edge) const
  {
    const BoundaryFace& face = plain.boundaryFaces[f];
    return std::max(counts[cornerOf(mesh, face, edge)], counts[cornerOf(mesh, face, edge + 1)]);
  }

  void addPrism(Index f, Index height)
  {
    const BoundaryFace& face = plain.boundaryFaces[f];
    const auto prism = static_cast<Index>(out.mesh.corners.size());
    std::array<Index, 8> corners;
    std::array<std::int32_t, 6> neighbors;
    neighbors.fill(DualMesh::noFace);
    for (const std::uint8_t c : hexahedronFace[face.direction])
    {
      const Index p = out.mesh.corners[face.element][c];
      corners[c] = chainPoint(p, height);
      corners[acrossAxis(c, axisOf(face.direction))] = chainPoint(p, height + 1);
    }
    const bool last = height + 1 == stackOf(f);
    neighbors[face.direction] = height == 0 ? ~static_cast<std::int32_t>(f) : static_cast<std::int32_t>(prism) - 1;
    neighbors[opposite(face.direction)] = static_cast<std::int32_t>(last ? face.element : prism + 1);
    for (int edge = 0; edge < 4; ++edge)
    {
      neighbors[besideEdge(face.direction, edge)] = lateral(f, edge, height, prism);
    }
    appendElement(out.mesh, corners, neighbors, out.mesh, face.element);
    out.wallFaces.push_back(f);
    out.heights.push_back(height);
  }

  /// Returns the neighbor of a prism across an edge of its wall: a prism, or a new boundary face on a side of the
  /// domain.
  std::int32_t lateral(Index f, int edge, Index height, Index prism)
  {
    const BoundaryFace& face = plain.boundaryFaces[f];
    const Index code = walls.graph.across[f][edge];
    if (!BoundaryGraph::isEdge(code) || height >= highestAt(out.mesh, f, edge))
    {
      return DualMesh::noFace;
    }
    const Index other = BoundaryGraph::faceOf(code);
    if (!isSide(code))
    {
      return static_cast<std::int32_t>(prismAt(other, height));
    }
    BoundaryFace side = plain.boundaryFaces[other];
    side.element = prism;
    side.direction = static_cast<std::uint8_t>(besideEdge(face.direction, edge));
    side.opposite = noIndex;
    out.mesh.boundaryFaces.push_back(side);
    return ~static_cast<std::int32_t>(out.mesh.boundaryFaces.size() - 1);
  }

  /// Gives a wall's boundary face to the lowest prism on it.
  void moveBoundary(Index f)
  {
    BoundaryFace& face = out.mesh.boundaryFaces[f];
    if (walls.roles[f] == FaceRole::tube)
    {
      joinTube(f);
      return;
    }
    const Index behind = faceBehind(plain, plain.boundaryFaces[f]);
    if (behind != noIndex && stackOf(behind) > 0)
    {
      face.opposite = prismAt(behind, 0);
    }
    if (stackOf(f) > 0)
    {
      out.mesh.neighbors[face.element][face.direction] = static_cast<std::int32_t>(prismAt(f, stackOf(f) - 1));
      face.element = prismAt(f, 0);
    }
  }

  /// Makes the elements on both sides of a tube's face neighbors. The face outside comes before it.
  void joinTube(Index f)
  {
    BoundaryFace& inside = out.mesh.boundaryFaces[f];
    const BoundaryFace& outside = plain.boundaryFaces[f - 1];
    inside.opposite = stackOf(f - 1) > 0 ? prismAt(f - 1, 0) : outside.element;
    out.mesh.neighbors[inside.element][inside.direction] = static_cast<std::int32_t>(inside.opposite);
    out.mesh.neighbors[inside.opposite][outside.direction] = static_cast<std::int32_t>(inside.element);
  }

  /// Gives the faces between the prisms on either side of a zone's faces to the zone.
  void extendZones()
  {
    for (const ZoneEdge& zone : zoneEdges)
    {
      const std::uint8_t direction = plain.boundaryFaces[zone.face].direction;
      for (Index height = 0; height < highestAt(out.mesh, zone.face, zone.edge); ++height)
      {
        out.mesh.zoneFaces.push_back({prismAt(zone.face, height), zone.tag,
                                      static_cast<std::uint8_t>(besideEdge(direction, zone.edge)), zone.side});
      }
    }
  }

  const DualMesh& plain;
  const LayerWalls& walls;
  const std::vector<Index>& counts;
  const Executor& executor;
  LayerMesh out;
  /// First point of each point's chain, and first element of each boundary face's stack.
  std::vector<Index> firstNew;
  std::vector<Index> firstPrism;
  std::size_t sideCount;
  std::vector<ZoneEdge> zoneEdges;
};

} // namespace

Index LayerMesh::prismOn(Index face, Index height) const
{
  const auto first = static_cast<std::size_t>(std::ranges::lower_bound(wallFaces, face) - wallFaces.begin());
  const std::size_t place = first + height;
  return place < wallFaces.size() && wallFaces[place] == face ? plainElements + static_cast<Index>(place) : noIndex;
}

LayerMesh withoutLayer(DualMesh plain)
{
  LayerMesh out;
  out.plainPoints = static_cast<Index>(plain.points.size());
  out.plainElements = static_cast<Index>(plain.elementCount());
  out.copies.assign(out.plainPoints, noIndex);
  out.mesh = std::move(plain);
  return out;
}

LayerMesh buildLayer(const DualMesh& plain, const LayerWalls& walls, const std::vector<Index>& counts,
                     const Executor& executor)
{
  return Builder(plain, walls, counts, executor).copyAndBuild();
}

LayerMesh takeLayer(DualMesh& plain, const LayerWalls& walls, const std::vector<Index>& counts,
                    const Executor& executor)
{
  return Builder(plain, walls, counts, executor).takeAndBuild(plain);
}

} // namespace atria
