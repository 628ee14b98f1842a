// SPDX-License-Identifier: GPL-3.0-or-later
/// What became of the layers that were asked for.
#pragma once

#include "Layer/LayerTopology.h"

#include <functional>

namespace atria {

/// Of one surface, both sides together.
struct LayerCoverage
{
  std::string surface;
  /// What was asked for; 0 where a layer is only at elements that cannot be valid without.
  int layers = 0;
  /// Area of its faces; of those on which elements of a layer stand, which may thin out to nothing at a corner or edge;
  /// of those on which elements of all layers stand, which may taper off likewise. Square model units.
  double area = 0.0;
  double layered = 0.0;
  double full = 0.0;
  /// Thickness got over thickness asked for, mean over the layered area; 0 where there is none.
  double thickness = 0.0;
};

struct LayerReport
{
  /// Per boundary face of the mesh: the number of elements in the stack on it, and the thickness of all of them across
  /// the face, mean of the corners; 0 where there are none.
  std::vector<std::int32_t> counts;
  std::vector<double> thicknesses;
  /// Surfaces, and bare sides, on which layers were asked for and that have faces, or on which elements needed one.
  std::vector<LayerCoverage> surfaces;
};

/// Where the mesh is one of several parts: which boundary faces are counted, and what sums up over all parts.
struct CoverageShare
{
  std::function<bool(Index face)> isCounted;
  std::function<std::vector<double>(const std::vector<double>&)> sum;
};

/// By point of the mesh that layers were grown from, how large its elements are beside the walls there: this says how
/// thick layers should be that have no height of their own.
std::vector<double> sizesBesideWalls(const DualMesh& plain, const LayerWalls& walls, const RunContext& context);

/// `walls` and `sizes` are those of the mesh the layers were grown from.
LayerReport reportLayers(const LayerMesh& layer, const LayerWalls& walls, const std::vector<double>& sizes,
                         const LayerOptions& options, const std::vector<std::string>& surfaceNames,
                         const CoverageShare& share = {});

} // namespace atria
