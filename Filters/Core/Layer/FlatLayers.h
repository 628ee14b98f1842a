// SPDX-License-Identifier: GPL-3.0-or-later
/// Measures of cells that follow from the heights of layers alone.
#pragma once

#include "Dual/Mesh/DualMesh.h"
#include "Layer/LayerWalls.h"

#include <limits>

namespace atria {

/// Measures of the cells of layers with a given height on a flat wall, far from its edges, and of the cells beside
/// them; see QualityTargets. No mesh with these heights has better ones there. Infinite where no height is given.
struct FlatLayers
{
  double convexity = std::numeric_limits<double>::infinity();
  double weight = std::numeric_limits<double>::infinity();
  double volumeRatio = std::numeric_limits<double>::infinity();
  double cornerVolume = std::numeric_limits<double>::infinity();
  double determinantRoot = std::numeric_limits<double>::infinity();
  /// Corner volume of the layers before they are divided.
  double cornerVolumeOfAll = std::numeric_limits<double>::infinity();

  /// Keeps the lower of each measure.
  void lower(const FlatLayers& other);
};

/// Returns the measures of layers on cubes of edge length `size`.
FlatLayers flatLayers(const WallLayers& layers, double size);

/// Returns the lowest measures over all faces of a mesh whose tags have layers with a given height, except on the
/// largest tenth of the faces of each tag.
FlatLayers flatLayers(const DualMesh& mesh, const LayerOptions& options);

} // namespace atria
