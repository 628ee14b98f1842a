// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes places on the model's surfaces, as dense as the grid is fine there.
#pragma once

#include "Dual/Zones/ModelViews.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// Areas of parts that see no air, by View, in square model units.
using ViewAreas = std::array<double, viewCount>;

/// A place on a surface.
struct SurfaceSample
{
  /// Along the grid's axes, in model units.
  Vec3 at;
  Index surface;
  /// Length of the grid's edge it was taken on, in model units.
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

/// Returns a place on each surface for each edge of the grid that leads to it from air past no other wall, in the order
/// of edges: the mesh has a face there. None are about leaves that are clusters.
/// \param share  Whose edges. \param ofZone  By zone of `zones`. O(crossings).
std::vector<SurfaceSample> sampleSurfaces(const Crossings& crossings, const Zones& zones,
                                          const std::vector<View>& ofZone, const ViewShare& share,
                                          const MeshingContext& context);

} // namespace atria
