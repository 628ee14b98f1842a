// SPDX-License-Identifier: GPL-3.0-or-later
#include "Quality/Faces/CellShapes.h"

namespace atria {

namespace {

constexpr LocalFace tetrahedronFaces[] = {{3, {0, 1, 3}}, {3, {1, 2, 3}}, {3, {2, 0, 3}}, {3, {0, 2, 1}}};
constexpr LocalFace hexahedronFaces[] = {{4, {0, 4, 7, 3}}, {4, {1, 2, 6, 5}}, {4, {0, 1, 5, 4}},
                                         {4, {3, 7, 6, 2}}, {4, {0, 3, 2, 1}}, {4, {4, 5, 6, 7}}};
// A voxel is a hexahedron whose corners 2 and 3, 6 and 7 are exchanged.
constexpr LocalFace voxelFaces[] = {{4, {0, 4, 6, 2}}, {4, {1, 3, 7, 5}}, {4, {0, 1, 5, 4}},
                                    {4, {2, 6, 7, 3}}, {4, {0, 2, 3, 1}}, {4, {4, 5, 7, 6}}};
constexpr LocalFace wedgeFaces[] = {
    {3, {0, 1, 2}}, {3, {3, 5, 4}}, {4, {0, 3, 4, 1}}, {4, {1, 4, 5, 2}}, {4, {2, 5, 3, 0}}};
constexpr LocalFace pyramidFaces[] = {
    {4, {0, 3, 2, 1}}, {3, {0, 1, 4}}, {3, {1, 2, 4}}, {3, {2, 3, 4}}, {3, {3, 0, 4}}};

} // namespace

CellShape shapeOf(unsigned char cellType)
{
  switch (cellType)
  {
    case tetrahedronCell:
      return {4, tetrahedronFaces};
    case voxelCell:
      return {8, voxelFaces};
    case hexahedronCell:
      return {8, hexahedronFaces};
    case wedgeCell:
      return {6, wedgeFaces};
    case pyramidCell:
      return {5, pyramidFaces};
    default:
      return {};
  }
}

} // namespace atria
