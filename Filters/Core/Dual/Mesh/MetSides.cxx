// SPDX-License-Identifier: GPL-3.0-or-later
#include "Dual/Mesh/MetSides.h"

#include "Grid/Prism.h"

namespace atria {

std::vector<MetSides> findMetSides(const DualMesh& mesh, std::size_t surfaceCount, const std::vector<char>& hasOpposite)
{
  std::vector<MetSides> met(surfaceCount + sideNumbers);
  for (std::size_t f = 0; f < mesh.boundaryFaces.size(); ++f)
  {
    const BoundaryFace& face = mesh.boundaryFaces[f];
    const bool isFront = face.side == SheetSide::front;
    met[face.tag].add({isFront, !isFront, hasOpposite.empty() ? face.opposite != noIndex : hasOpposite[f] != 0, false});
  }
  for (const ZoneFace& face : mesh.zoneFaces)
  {
    met[face.tag].within = true;
  }
  return met;
}

} // namespace atria
