// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides a scene into named surfaces, and excludes some of them.
#pragma once

#include "Diagnostics.h"
#include "Scene.h"

#include "AtriaIOSurfaceModule.h"

namespace atria::scene {

/// The rule that divides a scene into surfaces.
enum class SurfaceBy
{
  shape,
  group,    ///< the innermost named group
  material, ///< shapes of one look
  connected ///< pieces of shapes that are smooth in themselves
};

struct Surface
{
  std::string name;
  Material material; ///< material of its first shape that has one
};

struct Surfaces
{
  std::vector<Index> ids; ///< per triangle
  std::vector<Surface> surfaces;
};

/// Divides the scene's triangles into surfaces, numbered in the order of their first triangles, and names them.
///
/// A surface goes by the DEF name of its shape or geometry, else of the innermost named group, else of the material,
/// else `Shape`. Names that repeat get the name of the outermost group in which they differ ahead of them, as in
/// `East/Wall` and `West/Wall`; those that still repeat are numbered in the order of the file: `Wall`, `Wall_2`.
/// Made-up names keep clear of the file's own. `splitAngle`, in degrees, is the angle between neighbors above which
/// SurfaceBy::connected parts them.
ATRIAIOSURFACE_EXPORT Surfaces makeSurfaces(const Scene& scene, SurfaceBy by, double splitAngle);

/// Removes the surfaces whose names match one of the patterns, with their points, and notes which. Warns of a pattern
/// that matches none. Throws Error if nothing is left.
void excludeSurfaces(Scene& scene, Surfaces& surfaces, const std::vector<std::string>& patterns,
                     Diagnostics& diagnostics);

} // namespace atria::scene
