// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Domain/Ground.h"

#include <string>

namespace atria {

/// Which surfaces are terrain: those whose names fit `pattern`; if it is empty, the surface named `site` where its
/// triangles span more than `flatness` in height. Throws Error where a given pattern fits no surface.
SurfaceFlags terrainSurfaces(const TriangleSurface& surface, const std::string& pattern, const std::string& site,
                             double flatness);

/// What was found of a terrain's outline.
struct TerrainOutline
{
  std::size_t borderEdges = 0;      ///< that one triangle uses
  std::size_t nonManifoldEdges = 0; ///< that three or more use
  std::size_t openBorders = 0;      ///< border edges about holes, which are left open: buildings may stand in them
};

/// Extends the terrain level to the rectangle that holds it and `reach` (x and y alone count): the outline's points go
/// straight to the rectangle's sides they face, and the space between is triangulated, with the terrain's surface
/// ids. So along an outline parallel to the sides each point has the height of the outline's nearest point. Parts of
/// the terrain that lie apart are joined. Holes are not filled. Points within `tolerance` of each other are one. Throws
/// Error where the terrain has no extent. O(n log n), O(m^2) for m points of the outline.
TerrainOutline extendTerrain(TriangleSurface& surface, const SurfaceFlags& isTerrain, const Box3& reach,
                             double tolerance);

} // namespace atria
