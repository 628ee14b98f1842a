// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/LayerWalls.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace atria {

namespace {

std::array<Index, 4> sortedPoints(const DualMesh& mesh, Index f)
{
  const BoundaryFace& face = mesh.boundaryFaces[f];
  std::array<Index, 4> points{cornerOf(mesh, face, 0), cornerOf(mesh, face, 1), cornerOf(mesh, face, 2),
                              cornerOf(mesh, face, 3)};
  std::sort(points.begin(), points.end());
  // A triangle has one of its points twice; it does not matter which.
  std::fill(std::unique(points.begin(), points.end()), points.end(), noIndex);
  return points;
}

/// True if a face beside this one has the same points.
bool isDoubled(const DualMesh& mesh, const BoundaryGraph& graph, Index f)
{
  const auto& across = graph.across[f];
  return std::any_of(across.begin(), across.end(), [&](Index code) {
    return BoundaryGraph::isEdge(code) && sortedPoints(mesh, f) == sortedPoints(mesh, BoundaryGraph::faceOf(code));
  });
}

class Counter
{
public:
  /// `doubled` marks faces beside one that has the same points.
  Counter(const DualMesh& m, const LayerOptions& o, const LayerWalls& w, const std::vector<char>& d)
      : mesh(m), options(o), walls(w), doubled(d)
  {
  }

  Index at(Index point) const
  {
    Index most = 0;
    for (const Index f : walls.graph.facesAt(point))
    {
      if (walls.roles[f] == FaceRole::fixed)
      {
        return 0;
      }
      if (walls.roles[f] == FaceRole::wall)
      {
        most = std::max(most, static_cast<Index>(options.ofTag[mesh.boundaryFaces[f].tag].layers));
        if (doubled[f])
        {
          return 0;
        }
      }
    }
    return most > 0 && isOneRun(fanAt(mesh, walls.graph, point)) ? most : 0;
  }

private:
  bool isOneRun(const std::vector<Index>& fan) const
  {
    int changes = 0;
    for (std::size_t i = 0; i < fan.size(); ++i)
    {
      changes += walls.roles[fan[i]] != walls.roles[fan[(i + 1) % fan.size()]] ? 1 : 0;
    }
    return !fan.empty() && changes <= 2;
  }

  const DualMesh& mesh;
  const LayerOptions& options;
  const LayerWalls& walls;
  const std::vector<char>& doubled;
};

} // namespace

LayerWalls findLayerWalls(const DualMesh& mesh, const LayerOptions& options, const RunContext& context)
{
  LayerWalls walls;
  walls.graph = findBoundaryGraph(mesh, context);
  walls.roles.resize(mesh.boundaryFaces.size());
  for (std::size_t f = 0; f < walls.roles.size(); ++f)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    walls.roles[f] = options.ofTag[face.tag].layers > 0 ? FaceRole::wall
                     : face.onDomainSide                ? FaceRole::slide
                                                        : FaceRole::fixed;
  }
  walls.counts.resize(mesh.points.size());
  std::vector<char> doubled(walls.roles.size(), 0);
  context.executor.forEach(doubled.size(), 2048, [&](std::size_t f) {
    doubled[f] = walls.roles[f] == FaceRole::wall && isDoubled(mesh, walls.graph, static_cast<Index>(f)) ? 1 : 0;
  });
  const Counter counter(mesh, options, walls, doubled);
  context.executor.forEach(mesh.points.size(), 2048,
                           [&](std::size_t p) { walls.counts[p] = counter.at(static_cast<Index>(p)); });
  return walls;
}

std::vector<WallLayers> layersAskedAt(const DualMesh& mesh, const LayerWalls& walls, const LayerOptions& options)
{
  std::vector<WallLayers> out(mesh.points.size());
  for (Index f = 0; f < walls.roles.size(); ++f)
  {
    const WallLayers& asked = options.ofTag[mesh.boundaryFaces[f].tag];
    for (int i = 0; i < 4 && walls.roles[f] == FaceRole::wall; ++i)
    {
      WallLayers& most = out[cornerOf(mesh, mesh.boundaryFaces[f], i)];
      if (asked.layers != most.layers)
      {
        most = asked.layers > most.layers ? asked : most;
        continue;
      }
      most.firstHeight = most.firstHeight == 0.0    ? asked.firstHeight
                         : asked.firstHeight == 0.0 ? most.firstHeight
                                                    : std::min(most.firstHeight, asked.firstHeight);
      most.growth = std::min(most.growth, asked.growth);
    }
  }
  return out;
}

Vec3 wallNormal(const DualMesh& mesh, const BoundaryFace& face)
{
  const auto at = [&](int i) -> const Vec3& { return mesh.points[cornerOf(mesh, face, i)]; };
  return -0.5 * (at(2) - at(0)).cross(at(3) - at(1));
}

Vec3 sideNormal(const BoundaryFace& face, const LayerOptions& options)
{
  // Surfaces lie only on sides that are parallel to the grid.
  return face.tag >= options.surfaceCount()
             ? options.sideNormals[face.tag - options.surfaceCount()]
             : Vec3((isUpper(face.direction) ? 1.0 : -1.0) * Vec3::Unit(axisOf(face.direction)));
}

} // namespace atria
