// SPDX-License-Identifier: GPL-3.0-or-later
/// Heights of the layers on a wall.
#pragma once

#include "Layer/LayerWalls.h"

#include <vector>

namespace atria {

/// Completes requested layers for a wall beside elements of edge length `size`: `asManyAsFit` becomes the number at
/// which the next layer would be as high as what is left of these elements; `fittingGrowth` becomes the growth, from 1
/// to `maximumGrowth`, at which that is so for the requested number.
WallLayers fitted(const WallLayers& asked, double size);
inline constexpr double maximumGrowth = 2.0;
/// The largest number of layers that `asManyAsFit` becomes.
inline constexpr int mostLayers = 100;

/// Returns the largest number of layers that walls get beside elements of this edge length; 0 without walls.
int mostLayersOf(const std::vector<WallLayers>& walls, double size);

/// Returns the requested height of all layers at a point, in model units. `wallSize` is its size by findWallSizes.
double thicknessAsked(const WallLayers& layers, double wallSize, const LayerOptions& options);

/// Returns the shares of a line at which its layers end: one entry per layer, rising, the last 1. The line ends at
/// `height` above the wall. A first height is kept, and growth follows from it: from 1 to `maximumGrowth`, or to what
/// is requested if that is beyond. Heights are scaled if that is not enough.
std::vector<double> divideWay(const WallLayers& layers, double height);

} // namespace atria
