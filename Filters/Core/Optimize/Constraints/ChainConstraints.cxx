// SPDX-License-Identifier: GPL-3.0-or-later
#include "Optimize/Constraints/ChainConstraints.h"

namespace atria {

ChainConstraints::ChainConstraints(const LayerMesh& layer, VertexConstraints& points)
    : layer_(layer), points_(points), shares_(layer.wallPoints.size(), 1.0), hasChain_(layer.copies.size(), 0)
{
  for (Index p = 0; p < layer.plainPoints; ++p)
  {
    hasChain_[points.leaderOf(p)] |= layer.copies[p] != noIndex ? 1 : 0;
  }
  for (std::size_t i = 0; i < shares_.size(); ++i)
  {
    const Index wall = layer.wallPoints[i];
    const Index point = layer.plainPoints + static_cast<Index>(i);
    if (point != layer.copies[wall])
    {
      const Vec3& foot = layer.mesh.points[wall];
      const Vec3 way = layer.mesh.points[layer.copies[wall]] - foot;
      const double square = way.squaredNorm();
      shares_[i] = square > 0.0 ? (layer.mesh.points[point] - foot).dot(way) / square : 0.0;
    }
  }
}

} // namespace atria
