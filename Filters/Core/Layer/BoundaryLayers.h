// SPDX-License-Identifier: GPL-3.0-or-later
/// Division of the conforming layer into boundary layers.
#pragma once

#include "Layer/ConformingLayer.h"

namespace atria {

/// Divides the conforming layer: each copy's way from its wall point becomes a chain of as many layers as all walls
/// about the point ask for (the least of them), with the least of their first heights and of their growths. The points
/// of `one` are kept, those moved since it was grown too; new ones lie on the straight line between wall point and
/// copy.
///
/// The layers fill the way. If it is shorter than they should be in all, all heights are scaled down alike; if it is
/// longer, the first height is kept and growth is raised, to `maximumGrowth` at most, then all are scaled up. Without a
/// first height they grow as asked. Where a part of a valid prism would not be valid, its points get half as many
/// layers, and so on. `most` is the most layers each point may have; empty for any.
LayerMesh divideLayer(const DualMesh& plain, const LayerWalls& walls, const LayerMesh& one, const LayerOptions& options,
                      const std::vector<Index>& most, const RunContext& context);
inline constexpr double maximumGrowth = 2.0;

/// The shares of a way of length `way` at which its layers end: count entries, rising, the last 1.
std::vector<double> divideWay(const WallLayers& layers, double way);

/// What all walls about each point ask for: the least number, first height (of those that are given) and growth.
std::vector<WallLayers> layersOfPoints(const DualMesh& mesh, const LayerWalls& walls, const LayerOptions& options);

/// Grows the layer, excludes the points where it has no room (pointsWithoutRoom), and does so again until there are none;
/// then divides it. For use without an optimiser.
LayerMesh layWalls(const DualMesh& plain, const LayerWalls& walls, const LayerOptions& options,
                   const RunContext& context);

} // namespace atria
