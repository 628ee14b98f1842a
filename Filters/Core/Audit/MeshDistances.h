// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures how far a mesh's patches and the model's surfaces are from each other.
#pragma once

#include "Audit/SurfaceSamples.h"
#include "Dual/Mesh/MeshShare.h"

namespace atria {

/// The place farthest from what it should lie on.
struct FarthestPlace
{
  /// Distance in model units, and in sizes of the elements there.
  double distance = 0.0;
  double inElements = 0.0;
  /// Along the grid's axes until the mesh is placed in the model.
  Vec3 at = Vec3::Zero();
};

struct SurfaceDistances
{
  /// Farthest place from the surface among corners and middles of its faces.
  FarthestPlace ofFaces;
  /// Farthest place of the surface from the nearest of its faces; 0 below a tenth of an element. A surface without
  /// faces has none.
  FarthestPlace ofSurface;
};

/// Returns one entry per surface: the distances that are largest over the local element size, along the grid's axes.
/// \param samples  All samples of the surfaces, or those of this rank.
/// The result depends neither on threads nor on ranks. O(faces · log (triangles + faces)).
std::vector<SurfaceDistances> measureDistances(const DualMesh& mesh, const std::vector<SurfaceSample>& samples,
                                               const MeshShare& share, const MeshingContext& context);

} // namespace atria
