// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes places on the model's surfaces, as dense as the grid is fine there.
#pragma once

#include "Dual/Zones/ModelViews.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// Areas of parts that see no air, one entry per View, in square model units.
using ViewAreas = std::array<double, viewCount>;

/// A place on a surface.
struct SurfaceSample
{
  /// Along the grid's axes, in model units.
  Vec3 at;
  Index surface;
  /// Length of the grid edge that found the place, in model units.
  float size;
};

/// The parts of a model that air sees, as an audit of the mesh needs them.
struct SeenModel
{
  std::vector<TriangleViews> views; ///< one entry per triangle
  std::vector<float> airParts = {}; ///< one entry per triangle, or empty if air sees all of each. See findAirParts()
  std::vector<SurfaceSample> samples;
  /// One entry per surface: areas left aside because no air reaches them; see UnreachedParts.
  std::vector<ViewAreas> unreached = {};
};

/// Returns a place on each surface for each grid edge that leads to it from air past no other wall, in the order of
/// edges. The mesh has a face there. Edges around leaves that are clusters give none. O(crossings).
/// \param ofZone  One entry per zone of `zones`.
/// \param part    The part of the grid whose edges give places.
std::vector<SurfaceSample> sampleSurfaces(const Crossings& crossings, const Zones& zones,
                                          const std::vector<View>& ofZone, const GridPart& part,
                                          const MeshingContext& context);

} // namespace atria
