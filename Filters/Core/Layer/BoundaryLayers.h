// SPDX-License-Identifier: GPL-3.0-or-later
/// Division of the conforming layer into boundary layers.
#pragma once

#include "Layer/ConformingLayer.h"

namespace atria {

/// How many layers each point of the plain mesh is to have: what all walls about it ask for (the least of them), or
/// none where `one` has no layer.
std::vector<Index> layersWanted(const DualMesh& plain, const LayerWalls& walls, const LayerMesh& one,
                                const LayerOptions& options);

/// Lowers counts until those of neighbors on a wall differ by one at most, so that layers taper off one at a time, the
/// outermost and thickest first.
void limitSteps(const DualMesh& plain, const LayerMesh& one, const SettledPoints& settled, std::vector<Index>& counts);

/// Divides the conforming layer: each copy's way from its wall point becomes a chain of `counts` layers, with the least
/// of the first heights and of the growths that the walls about the point ask for. The points of `one` are kept, those
/// moved since it was grown too; new ones lie on the straight line between wall point and copy.
///
/// The layers fill the way. If it is shorter than they should be in all, all heights are scaled down alike; if it is
/// longer, the first height is kept and growth is raised, to `maximumGrowth` at most, then all are scaled up. Without a
/// first height they grow as asked, except beside points with fewer: there they are of one height.
LayerMesh divideLayer(const DualMesh& plain, const LayerWalls& walls, const LayerMesh& one, const LayerOptions& options,
                      const std::vector<Index>& counts);
inline constexpr double maximumGrowth = 2.0;

/// The shares of a way of length `way` at which its layers end: count entries, rising, the last 1.
std::vector<double> divideWay(const WallLayers& layers, double way);

/// What all walls about each point ask for: the least number, first height (of those that are given) and growth.
std::vector<WallLayers> layersOfPoints(const DualMesh& mesh, const LayerWalls& walls, const LayerOptions& options);

} // namespace atria
