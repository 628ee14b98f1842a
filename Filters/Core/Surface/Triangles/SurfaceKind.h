// SPDX-License-Identifier: GPL-3.0-or-later
/// Names the kinds of surfaces: walls, and zones that air passes through.
#pragma once

#include <cstdint>

namespace atria {

/// The effect of a surface on air.
enum class SurfaceKind : std::uint8_t
{
  wall,
  faceZone, ///< one can look through it: the faces on it are within the mesh, under its name
  cellZone  ///< one can look through it, and the cells it encloses have its name
};

} // namespace atria
