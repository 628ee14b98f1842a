// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/TurnedDomain.h"

#include "Support/Error.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace atria {

void markTurnedSides(Crossings& crossings, std::size_t surfaceCount)
{
  for (BoundaryFace& face : crossings.boundaryFaces)
  {
    face.onDomainSide = face.onDomainSide || face.tag >= surfaceCount;
  }
}

void dropBeyondSides(std::vector<char>& kept, const Zones& zones, const Octree& octree, const GridPoints& points)
{
  const GridFrame& frame = octree.frame();
  if (!frame.turnedDomain)
  {
    return;
  }
  const Box3& box = frame.turnedDomain->bounds;
  const Placement relative(frame.turnedDomain->axes.angle() - frame.placement.angle());
  std::vector<double> farthest(zones.count(), 0.0);
  for (Index leaf = 0; leaf < octree.leafCount(); ++leaf)
  {
    for (unsigned corner = 0; corner < 8; ++corner)
    {
      const Index point = points.atCorner[leaf][corner];
      if (point == noIndex)
      {
        continue;
      }
      const Vec3 p = relative.fromModel(frame.toModel(octree.cornerOf(leaf, corner)));
      const double beyond = std::max({box.min[0] - p[0], p[0] - box.max[0], box.min[1] - p[1], p[1] - box.max[1]});
      double& known = farthest[zones.ofPoint[point]];
      known = std::abs(beyond) > std::abs(known) ? beyond : known;
    }
  }
  for (std::size_t zone = 0; zone < kept.size(); ++zone)
  {
    kept[zone] = kept[zone] && farthest[zone] < 0.0;
  }
  if (std::find(kept.begin(), kept.end(), 1) == kept.end())
  {
    throw Error("no zone is left to mesh inside the turned domain: keep all zones, or give seeds inside it");
  }
}

void sharpenTurnedEdges(DualMesh& mesh, const GridFrame& frame, std::size_t surfaceCount)
{
  if (!frame.turnedDomain)
  {
    return;
  }
  std::map<Index, unsigned> sidesOf; // of points on the boundary, as bits by Direction
  for (const BoundaryFace& face : mesh.boundaryFaces)
  {
    if (face.tag < surfaceCount || face.tag - surfaceCount > yMax)
    {
      continue;
    }
    const ReducedFace reduced = faceOf(mesh.corners[face.element], face.direction);
    for (int i = 0; i < reduced.count; ++i)
    {
      sidesOf[reduced.points[i]] |= 1u << (face.tag - surfaceCount);
    }
  }
  const Box3& box = frame.turnedDomain->bounds;
  const Placement relative(frame.turnedDomain->axes.angle() - frame.placement.angle());
  std::map<std::pair<unsigned, double>, std::pair<double, Index>> nearest; // by edge and height: distance, point
  const auto onEdge = [&](Index point, unsigned sides) {
    Vec3 p = relative.fromModel(mesh.points[point]);
    p[0] = sides & 1u << xMax ? box.max[0] : box.min[0];
    p[1] = sides & 1u << yMax ? box.max[1] : box.min[1];
    return relative.toModel(p);
  };
  for (const auto& [point, sides] : sidesOf)
  {
    constexpr unsigned alongX = 1u << xMin | 1u << xMax;
    if ((sides & alongX) == 0 || (sides & ~alongX) == 0)
    {
      continue;
    }
    // Of two at one height the nearest, as they would become one.
    const double distance = (onEdge(point, sides) - mesh.points[point]).norm();
    const auto [known, isNew] = nearest.try_emplace({sides, mesh.points[point][2]}, std::pair(distance, point));
    if (!isNew)
    {
      known->second = std::min(known->second, std::pair(distance, point));
    }
  }
  for (const auto& [edge, found] : nearest)
  {
    mesh.points[found.second] = onEdge(found.second, edge.first);
  }
}

void placeInModel(DualMeshResult& result, const Placement& placement, const RunContext& context)
{
  if (placement.angle() == 0.0)
  {
    return;
  }
  std::vector<Vec3>& points = result.mesh.points;
  context.executor.forEach(points.size(), 65536, [&](std::size_t i) { points[i] = placement.toModel(points[i]); });
  for (Diagnostic& diagnostic : result.diagnostics)
  {
    diagnostic.begin = placement.toModel(diagnostic.begin);
    diagnostic.end = placement.toModel(diagnostic.end);
  }
}

} // namespace atria
