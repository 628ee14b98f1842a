// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures how far a mesh's patches and the model's surfaces are from each other.
#pragma once

#include "Audit/SurfaceSamples.h"
#include "Dual/Mesh/MeshShare.h"

namespace atria {

/// The place farthest from what it should lie on.
struct FarthestPlace
{
  /// In model units, and over the size of the elements there.
  double distance = 0.0;
  double inElements = 0.0;
  /// Along the grid's axes until the mesh is placed in the model.
  Vec3 at = Vec3::Zero();
};

struct SurfaceDistances
{
  /// From corners and middles of the surface's faces to the surface.
  FarthestPlace ofFaces;
  /// From places of the surface to the nearest of its faces; 0 below a tenth of an element. A surface without faces has
  /// none.
  FarthestPlace ofSurface;
};

/// Returns distances by surface, the largest over the local size of elements. Along the grid's axes.
/// \param samples  Of all of the surface, or what a rank has of it.
/// The result depends neither on threads nor on ranks. O(faces · log (triangles + faces)).
std::vector<SurfaceDistances> measureDistances(const DualMesh& mesh, const std::vector<SurfaceSample>& samples,
                                               const MeshShare& share, const MeshingContext& context);

} // namespace atria
