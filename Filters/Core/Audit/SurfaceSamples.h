// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes places on the model's surfaces, as dense as the octree is fine there.
#pragma once

#include "Dual/Zones/ModelViews.h"
#include "Octree/Tree/MeshingContext.h"

#include <functional>

namespace atria {

/// Areas of parts that see no air, by View, in square model units.
using ViewAreas = std::array<double, viewCount>;

/// A place on a surface.
struct SurfaceSample
{
  /// Along the grid's axes, in model units.
  Vec3 at;
  Index surface;
  /// Edge length of the leaf it was taken in, in model units.
  float size;
};

/// What the air sees of a model, as an audit of the mesh needs it.
struct SeenModel
{
  std::vector<TriangleViews> views; ///< by triangle
  std::vector<float> airParts = {}; ///< by triangle; all of it where this is empty. See findAirParts()
  std::vector<SurfaceSample> samples;
  /// By surface, what was left aside as no air reaches it; see UnreachedParts.
  std::vector<ViewAreas> unreached = {};
};

/// Returns one place for each leaf and each surface in it, the nearest to the leaf's center, in the order of leaves and
/// surfaces. Triangles that see neither air nor nothing are not asked, nor those that see air in part, and leaves that
/// are clusters have none. \param airParts  As SeenModel::airParts. \param isAsked  Which leaves are asked; all of them
/// where it is empty. O(leaves + pieces of the model in them).
std::vector<SurfaceSample> sampleSurfaces(const std::vector<TriangleViews>& views, const std::vector<float>& airParts,
                                          const std::function<bool(Index leaf)>& isAsked,
                                          const MeshingContext& context);

} // namespace atria
