// SPDX-License-Identifier: GPL-3.0-or-later
/// Corners and faces of prisms on walls, which have the axes of the element that had the wall.
#pragma once

#include "Dual/Mesh/DualMesh.h"

namespace atria {

/// Returns the corner across the element along an axis.
constexpr std::uint8_t acrossAxis(std::uint8_t corner, int axis)
{
  return hexahedronCorner[hexahedronCorner[corner] ^ (1u << axis)];
}

constexpr bool hasCorner(int direction, std::uint8_t corner)
{
  for (const std::uint8_t c : hexahedronFace[direction])
  {
    if (c == corner)
    {
      return true;
    }
  }
  return false;
}

/// Returns the direction of the face beside that of `direction` across its edge `edge`.
constexpr int besideEdge(int direction, int edge)
{
  for (int d = 0; d < 6; ++d)
  {
    if (axisOf(d) != axisOf(direction) && hasCorner(d, hexahedronFace[direction][edge]) &&
        hasCorner(d, hexahedronFace[direction][(edge + 1) % 4]))
    {
      return d;
    }
  }
  return -1;
}

} // namespace atria
