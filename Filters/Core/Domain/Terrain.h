// SPDX-License-Identifier: GPL-3.0-or-later
/// Finds terrain and extends it to a rectangle.
#pragma once

#include "Domain/Ground.h"

#include <string>

namespace atria {

/// Returns the surfaces that are terrain: those whose names fit `pattern`. If it is empty, the surface named `site` is
/// terrain if its triangles span more than `flatness` in height. Throws Error if a given pattern fits no surface.
SurfaceFlags terrainSurfaces(const TriangleSurface& surface, const std::string& pattern, const std::string& site,
                             double flatness);

/// Edges counted while a terrain is extended.
struct TerrainOutline
{
  std::size_t borderEdges = 0;      ///< edges that one triangle uses
  std::size_t nonManifoldEdges = 0; ///< edges that three triangles or more use
  std::size_t openBorders = 0;      ///< border edges around holes, which are left open: buildings may stand in them
};

/// Extends the terrain level to the rectangle that holds it and `reach`, of which only x and y count. Points of the
/// outline go straight to the sides of the rectangle that they face. The space between is triangulated with the
/// terrain's surface ids. Along an outline parallel to the sides each point thus has the height of the outline's
/// nearest point. Separate parts of the terrain are joined. Holes are not filled. Points within `tolerance` of each
/// other are merged. Throws Error if the terrain has no extent. O(n log n), O(m^2) for m points of the outline.
TerrainOutline extendTerrain(TriangleSurface& surface, const SurfaceFlags& isTerrain, const Box3& reach,
                             double tolerance);

} // namespace atria
