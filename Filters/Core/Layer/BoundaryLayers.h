// SPDX-License-Identifier: GPL-3.0-or-later
/// Division of the conforming layer into boundary layers.
#pragma once

#include "Layer/ConformingLayer.h"

namespace atria {

/// Returns the number of layers for each point of the plain mesh: the smallest number that the walls around it request,
/// or 0 if `one` has no layer there.
std::vector<Index> layersWanted(const DualMesh& plain, const LayerWalls& walls, const LayerMesh& one,
                                const LayerOptions& options);

/// Lowers counts until those of neighbors on a wall differ by one at most. Layers then taper off one at a time, the
/// outermost and thickest first.
void limitSteps(const DualMesh& plain, const LayerMesh& one, const SettledPoints& settled, std::vector<Index>& counts);

/// Divides the conforming layer: the line from each wall point to its copy becomes a chain of `counts` layers. It has
/// the smallest first height and the smallest growth that the walls around the point request. Points of `one` are kept,
/// also those that moved since it was grown. New points lie on the straight line between wall point and copy.
///
/// The layers fill the line. If it is shorter than their total height, all heights are scaled down alike. If it is
/// longer, the first height is kept and growth is raised, to `maximumGrowth` at most; then all heights are scaled up.
/// Without a first height, layers grow as requested, but have equal heights beside points with fewer layers.
LayerMesh divideLayer(const DualMesh& plain, const LayerWalls& walls, const LayerMesh& one, const LayerOptions& options,
                      const std::vector<Index>& counts);
inline constexpr double maximumGrowth = 2.0;

/// Returns the shares of a line of length `way` at which its layers end: one entry per layer, rising, the last 1.
std::vector<double> divideWay(const WallLayers& layers, double way);

/// Returns the layers of each point: the smallest number, first height (of those that are given) and growth that the
/// walls around it request.
std::vector<WallLayers> layersOfPoints(const DualMesh& mesh, const LayerWalls& walls, const LayerOptions& options);

} // namespace atria
