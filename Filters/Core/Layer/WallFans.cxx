// SPDX-License-Identifier: GPL-3.0-or-later
#include "Layer/WallFans.h"

#include "Support/UnionFind.h"

namespace atria {

namespace {

/// Returns the boundary face on the other side of a sheet or of a tube's cut; noIndex if there is none.
Index otherSideOf(const DualMesh& mesh, const EdgeTubes& tubes, Index face)
{
  if (tubes.has(face))
  {
    return tubes.firstFace + ((face - tubes.firstFace) ^ 1U);
  }
  return faceBehind(mesh, mesh.boundaryFaces[face]);
}

/// Returns sets of points that have one vertex and are connected through the two sides of sheets and cuts.
UnionFind findFans(const DualMesh& mesh, const EdgeTubes& tubes, const std::vector<Index>& vertexOf)
{
  UnionFind fans(mesh.points.size());
  for (Index f = 0; f < mesh.boundaryFaces.size(); ++f)
  {
    const Index other = otherSideOf(mesh, tubes, f);
    if (other == noIndex)
    {
      continue;
    }
    for (const Index p : cornersOf(mesh, mesh.boundaryFaces[f]))
    {
      for (const Index q : cornersOf(mesh, mesh.boundaryFaces[other]))
      {
        if (vertexOf[p] == vertexOf[q])
        {
          fans.join(p, q);
        }
      }
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
