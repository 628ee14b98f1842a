// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Constraints/LayerConstraints.h"

namespace atria {

LayerConstraints::LayerConstraints(const LayerMesh& layer, const LayerWalls& walls, const LayerOptions& options,
                                   const std::vector<Index>& leaders, VertexConstraints& plain)
    : layer_(layer), settled_(walls.settled), options_(options), plain_(plain), leaders_(leaders),
      sides_(layer.wallPoints.size(), 0)
{
  const DualMesh& mesh = layer.mesh;
  for (std::size_t f = 0; f < mesh.boundaryFaces.size() && !sides_.empty(); ++f)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    if (f < walls.roles.size() && walls.roles[f] != FaceRole::slide)
    {
      continue;
    }
    const bool isBare = face.tag >= options.surfaceCount();
    for (int i = 0; i < 4; ++i)
    {
      const Index p = cornerOf(mesh, face, i);
      if (p < layer.plainPoints && layer.copies[p] != noIndex)
      {
        sides_[layer.copies[p] - layer.plainPoints] |=
            SideBits{1} << (isBare ? face.tag - options.surfaceCount() : Index{face.direction});
      }
    }
  }
}

void LayerConstraints::prepare(std::span<const Index> points, const RunContext& context)
{
  std::vector<Index> plain;
  for (const Index p : points)
  {
    if (p < layer_.plainPoints)
    {
      plain.push_back(p);
    }
  }
  plain_.prepare(plain, context);
}

bool LayerConstraints::isMovable(Index point) const
{
  if (settled_.stays(layer_.wallPointOf(point)))
  {
    return false;
  }
  return layer_.isNew(point) || plain_.isMovable(point);
}

Vec3 LayerConstraints::place(Index point, const Vec3& p) const
{
  if (point < layer_.plainPoints)
  {
    return plain_.place(point, p);
  }
  const Index wall = layer_.wallPoints[point - layer_.plainPoints];
  const Vec3& start = layer_.mesh.points[wall];
  const SideBits sides = sidesOf(wall);
  Vec3 q = p;
  for (std::size_t side = 0; side < options_.sideNormals.size(); ++side)
  {
    if (sides >> side & 1)
    {
      const Vec3& normal = options_.sideNormals[side];
      q -= normal.dot(q - start) * normal;
      q = (normal.array().abs() == 1.0).select(start, q); // avoids rounding along the axes
    }
  }
  return q;
}

Ways LayerConstraints::waysFrom(Index point, const Vec3& p, double step) const
{
  if (point < layer_.plainPoints)
  {
    return plain_.waysFrom(point, p, step);
  }
  const bool slides = sidesOf(layer_.wallPoints[point - layer_.plainPoints]) != 0;
  return slides ? VertexConstraints::waysFrom(point, p, step) : Ways();
}

} // namespace atria
