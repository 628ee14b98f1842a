// SPDX-License-Identifier: GPL-3.0-or-later
/// Areas of faces, and the volumes that follow from them.
#pragma once

#include "Dual/Mesh/DualMesh.h"

#include <Eigen/Geometry>

namespace atria {

/// Outward area vector of a face, and the integral of a third of its points' product with it. The volume of a set of
/// elements is the sum of these integrals over the faces around it.
struct FaceFlux
{
  Vec3 area = Vec3::Zero();
  double volume = 0.0;
};

/// Returns the flux through a face of an element, triangulated around its middle. Positions are relative to `origin`,
/// which keeps the summands small.
inline FaceFlux fluxOf(const DualMesh& mesh, Index element, int direction, const Vec3& origin)
{
  const ReducedFace face = faceOf(mesh.corners[element], direction);
  const auto at = [&](int i) { return Vec3(mesh.points[face.points[i % face.count]] - origin); };
  Vec3 middle = Vec3::Zero();
  for (int i = 0; i < face.count; ++i)
  {
    middle += at(i) / face.count;
  }
  FaceFlux flux;
  for (int i = 0; i < face.count; ++i)
  {
    const Vec3 area = 0.5 * (at(i) - middle).cross(at(i + 1) - middle);
    flux.area += area;
    flux.volume += area.dot(middle + at(i) + at(i + 1)) / 9.0;
  }
  return flux;
}

} // namespace atria
