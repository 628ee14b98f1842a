// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/WallFans.h"

namespace atria {

namespace {

/// Returns sets of points that have one vertex and are connected through the two sides of sheets and cuts.
UnionFind findFans(const DualMesh& mesh, const EdgeTubes& tubes, const std::vector<Index>& vertexOf)
{
  UnionFind fans(mesh.points.size());
  for (Index f = 0; f < mesh.boundaryFaces.size(); ++f)
  {
    const Index other = tubes.has(f) ? tubes.across(f) : faceBehind(mesh, mesh.boundaryFaces[f]);
    if (other != noIndex)
    {
      joinSame(mesh, f, other, vertexOf, fans);
    }
  }
  return fans;
}

} // namespace

void separateFans(const DualMesh& mesh, const EdgeTubes& tubes, VertexClassification& classification,
                  std::vector<Index>& vertexOf)
{
  UnionFind fans = findFans(mesh, tubes, vertexOf);
  for (auto p = static_cast<Index>(classification.classes.size()); p < vertexOf.size(); ++p)
  {
    classification.appendCopyOf(vertexOf[p]);
    vertexOf[p] = fans.find(p);
  }
}

} // namespace atria
