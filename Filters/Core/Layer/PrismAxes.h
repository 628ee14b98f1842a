// SPDX-License-Identifier: GPL-3.0-or-later
/// Prisms on walls have the axes of the element that had the wall.
#pragma once

#include "Dual/Mesh/DualMesh.h"

namespace atria {

/// The corner across the element along an axis.
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

/// The face beside that of `direction` along its edge i.
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
