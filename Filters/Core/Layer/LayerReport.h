// SPDX-License-Identifier: GPL-3.0-or-later
/// Report on the layers that were built.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace atria {

/// Layers of one surface, both sides together.
struct LayerCoverage
{
  std::string surface;
  /// Number of layers requested; 0 if the surface has layers only at elements that cannot be valid without, or where
  /// those of other walls end on it.
  int layers = 0;
  /// Area of all its faces, of faces with elements of a layer, and of faces with elements of all layers; square model
  /// units. Elements may thin out to nothing at a corner or edge of such a face.
  double area = 0.0;
  double layered = 0.0;
  double full = 0.0;
  /// Actual over requested thickness, mean over the layered area; 0 if there is none.
  double thickness = 0.0;
  /// Height of the elements on the wall, with or without a layer; mean over the area, model units.
  double firstHeight = 0.0;
};

/// Layers that are too thin for checks of checkMesh, wherever they are.
struct ThinLayers
{
  /// Names of the checks (docs/arrays.md) that fail even on a flat wall.
  std::vector<std::string> failingChecks;
  /// Says why, and what to do; empty if none fails.
  std::string note;
};

struct LayerReport
{
  /// One entry per boundary face of the mesh: the number of elements in the stack on it, and their total thickness
  /// across the face (mean of the corners, model units); 0 if there are none.
  std::vector<std::int32_t> counts;
  std::vector<double> thicknesses;
  /// Surfaces and bare sides that have faces and were to get layers, or have some.
  std::vector<LayerCoverage> surfaces;
  ThinLayers thin;
};

} // namespace atria
