// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Unions/SplitCells.h"

#include "Quality/Faces/Geometry.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace atria {

namespace {

/// Triangle between two pyramids of a cell; its normal points out of the owner.
struct Triangle
{
  std::array<Index, 3> points;
  Index owner;
  Index neighbor;
};

class CellSplitter
{
public:
  explicit CellSplitter(FaceMesh& faceMesh)
      : mesh(faceMesh), cellFaces(makeCellFaces(faceMesh)), owners(faceMesh.owner.begin(), faceMesh.owner.end()),
        neighbors(faceMesh.neighbor.begin(), faceMesh.neighbor.end())
  {
    neighbors.resize(owners.size(), noIndex);
  }

  void split(Index cell)
  {
    const auto apex = static_cast<Index>(mesh.points.size());
    mesh.points.push_back(centroidOf(cell));
    std::map<std::pair<Index, Index>, Index> pyramidAt; // pyramid of each edge, directed as in the pyramid's face
    Index pyramid = cell;
    for (const Index face : cellFaces.of(cell))
    {
      const std::vector<Index> loop = outward(face, cell);
      (mesh.owner[face] == cell ? owners : neighbors)[face] = pyramid;
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        const std::pair<Index, Index> edge{loop[i], loop[(i + 1) % loop.size()]};
        const auto other = pyramidAt.find({edge.second, edge.first});
        if (other == pyramidAt.end())
        {
          pyramidAt.emplace(edge, pyramid);
          continue;
        }
        triangles.push_back({{edge.first, edge.second, apex}, other->second, pyramid});
        pyramidAt.erase(other);
      }
      pyramid = static_cast<Index>(mesh.cellCount + cellOf.size());
      cellOf.push_back(cell);
    }
    cellOf.pop_back();
  }

  SplitCells writeFaces()
  {
    std::vector<OrderedFace> order;
    const auto before = static_cast<Index>(mesh.faceCount());
    for (Index face = 0; face < before; ++face)
    {
      order.push_back(orderFace(face, owners[face], neighbors[face]));
    }
    for (Index i = 0; i < triangles.size(); ++i)
    {
      order.push_back(orderFace(before + i, triangles[i].owner, triangles[i].neighbor));
    }
    std::sort(order.begin(), order.end());
    FaceMesh out;
    SplitCells split{std::vector<Index>(before), std::move(cellOf)};
    for (const OrderedFace& face : order)
    {
      if (face.face < before)
      {
        split.faceOf[face.face] = static_cast<Index>(out.owner.size());
      }
      appendFace(out, face,
                 face.face < before ? mesh.face(face.face)
                                    : std::span<const Index>(triangles[face.face - before].points));
    }
    out.cellCount = mesh.cellCount + split.cellOf.size();
    out.points = std::move(mesh.points);
    mesh = std::move(out);
    return split;
  }

private:
  std::vector<Index> outward(Index face, Index cell) const
  {
    std::vector<Index> loop(mesh.face(face).begin(), mesh.face(face).end());
    if (mesh.owner[face] != cell)
    {
      std::reverse(loop.begin(), loop.end());
    }
    return loop;
  }

  Vec3 centroidOf(Index cell) const
  {
    const auto faces = cellFaces.of(cell);
    return measureCellInOrder(faces.size(),
                              [&](std::size_t i) { return measurePolygon(mesh.points, outward(faces[i], cell)); })
        .centroid;
  }

  FaceMesh& mesh;
  const CellFaces cellFaces;
  std::vector<Index> owners;
  std::vector<Index> neighbors; ///< noIndex on the boundary
  std::vector<Index> cellOf;
  std::vector<Triangle> triangles;
};

} // namespace

SplitCells splitIntoPyramids(FaceMesh& mesh, std::span<const Index> cells)
{
  CellSplitter splitter(mesh);
  for (const Index cell : cells)
  {
    splitter.split(cell);
  }
  return splitter.writeFaces();
}

} // namespace atria
