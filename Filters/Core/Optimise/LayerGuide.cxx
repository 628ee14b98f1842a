// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimise/LayerGuide.h"

namespace atria {

LayerGuide::LayerGuide(const LayerMesh& layer, const LayerWalls& walls, const LayerOptions& options,
                       const std::vector<Index>& leaders, const std::vector<char>& letGo, VertexGuide& plain)
    : layer_(layer), options_(options), plain_(plain), leaders_(leaders), pinned_(layer.plainPoints, 0),
      sides_(layer.plainPoints, 0)
{
  const DualMesh& mesh = layer.mesh;
  for (std::size_t f = 0; f < mesh.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    const bool slides = f >= walls.roles.size() || walls.roles[f] == FaceRole::slide;
    const bool isBare = face.tag >= options.surfaceCount();
    for (int i = 0; i < 4; ++i)
    {
      const Index p = cornerOf(mesh, face, i);
      if (p < layer.plainPoints)
      {
        pinned_[p] = pinned_[p] || options.ofTag[face.tag].firstHeight > 0.0;
        sides_[p] |= slides ? 1U << (isBare ? face.tag - options.surfaceCount() : face.direction) : 0U;
      }
    }
  }
  for (Index p = 0; p < layer.plainPoints; ++p)
  {
    pinned_[leaders_[p]] = pinned_[leaders_[p]] || pinned_[p];
  }
  for (Index p = 0; p < layer.plainPoints; ++p)
  {
    pinned_[p] = pinned_[leaders_[p]] && !letGo[leaders_[p]];
  }
}

void LayerGuide::prepare(std::span<const Index> points, const RunContext& context)
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

bool LayerGuide::isMovable(Index point) const
{
  return point < layer_.plainPoints ? !pinned_[leaders_[point]] && plain_.isMovable(point)
                                    : !pinned_[layer_.wallPoints[point - layer_.plainPoints]];
}

Vec3 LayerGuide::place(Index point, const Vec3& p) const
{
  if (point < layer_.plainPoints)
  {
    return plain_.place(point, p);
  }
  const Index wall = layer_.wallPoints[point - layer_.plainPoints];
  const Vec3& start = layer_.mesh.points[wall];
  Vec3 q = p;
  for (int side = 0; side < 6; ++side)
  {
    if (sides_[wall] >> side & 1)
    {
      const Vec3& normal = options_.sideNormals[side];
      q -= normal.dot(q - start) * normal;
      const int axis = axisOf(side);
      q[axis] = std::abs(normal[axis]) == 1.0 ? start[axis] : q[axis];
    }
  }
  return q;
}

Ways LayerGuide::waysFrom(Index point, const Vec3& p, double step) const
{
  if (point < layer_.plainPoints)
  {
    return plain_.waysFrom(point, p, step);
  }
  const bool slides = sides_[layer_.wallPoints[point - layer_.plainPoints]] != 0;
  return slides ? VertexGuide::waysFrom(point, p, step) : Ways();
}

} // namespace atria
