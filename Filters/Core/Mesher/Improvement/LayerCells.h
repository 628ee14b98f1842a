// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells and points of a mesh with a layer that the stages of LayerImprover look at.
#pragma once

#include "Layer/LayerTopology.h"
#include "Optimize/Kernel/Optimizer.h"

namespace atria {

/// Cells below this share of a target are no better than not valid.
inline constexpr float soundEnough = 0.02F;

/// What no cell falls below by other measures for the good of angles, where the limit of these rises.
inline constexpr double leastOfOthers = 0.1;

std::vector<ShortCell> badOf(const std::vector<ShortCell>& cells);

std::vector<Index> cellsOf(const std::vector<ShortCell>& cells);

/// Those on the boundary, and those of the layer.
std::vector<char> pointsToEvaluate(const LayerMesh& layer, const Executor& executor);

/// Puts the copies of a layer where they are in another one of the same mesh, the outermost where there are several,
/// but for those above points of the wall marked in `but`.
void takeCopies(const LayerMesh& from, const std::vector<char>& but, LayerMesh& to);

/// Marks the points of cells, or those of the wall that they stand above.
void markPoints(const LayerMesh& layer, const std::vector<ShortCell>& cells, std::vector<char>& marked);

} // namespace atria
