// SPDX-License-Identifier: GPL-3.0-or-later
/// Random scenes of buildings whose meshes are known: areas, volumes and footprints.
#pragma once

#include "Mesher/MeshModel.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace atria::testing {

/// A model, how to mesh it, and what the mesh must have. Lengths are in meters.
struct Scene
{
  TriangleSurface surface;
  MesherOptions options;
  /// Of the faces in the mesh, by the name of the surface, in square meters. Both sides of a sheet count. Surfaces that
  /// are not listed have no faces.
  std::map<std::string, double> areas;
  /// Surfaces with air on both sides.
  std::set<std::string> sheets;
  /// Volume of the air without buildings, in cubic meters. 0: that of the domain.
  double emptyVolume = 0.0;
  /// What buildings take of it.
  double displaced = 0.0;
  /// Area of the ground that buildings cover, seen from above, in square meters.
  double footprint = 0.0;
  /// The domain is the model's bounds, and air is in `roomVolume` alone.
  bool isIndoors = false;
  double roomVolume = 0.0;
};

struct SceneKind
{
  const char* name;
  /// Returns the same scene for the same seed.
  Scene (*make)(unsigned seed);
};

const std::vector<SceneKind>& sceneKinds();

/// Returns a scene turned about the vertical. Its domain stays, but for rooms, whose domain turns with them.
Scene turnedScene(const SceneKind& kind, unsigned seed, double degrees);

} // namespace atria::testing
