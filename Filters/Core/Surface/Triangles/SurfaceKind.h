// SPDX-License-Identifier: GPL-3.0-or-later
/// Kinds of surfaces: walls, and what air passes through.
#pragma once

#include <cstdint>

namespace atria {

/// What a surface is to the air.
enum class SurfaceKind : std::uint8_t
{
  wall,
  faceZone, ///< one can look through it: the faces on it are within the mesh, under its name
  cellZone  ///< one can look through it, and what it encloses has its name
};

} // namespace atria
