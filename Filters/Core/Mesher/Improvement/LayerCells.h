// SPDX-License-Identifier: GPL-3.0-or-later
/// Selects cells and points of a mesh with a layer for the stages of the improver.
#pragma once

#include "Layer/LayerTopology.h"
#include "Mesher/Improvement/ImproverStages.h"

namespace atria {

/// Returns the bad cells; see badBelow.
std::vector<ShortCell> badOf(const std::vector<ShortCell>& cells);

/// Marks the points on the boundary, at zone faces, and of the layer.
std::vector<char> pointsToEvaluate(const LayerMesh& layer, const Executor& executor);

/// Moves the outermost copies of a layer to where they are in another layer of the same mesh, except above wall points
/// marked in `but`.
void takeCopies(const LayerMesh& from, const std::vector<char>& but, LayerMesh& to);

/// Marks the wall points below the points of cells; points that have none below mark themselves.
void markPoints(const LayerMesh& layer, const std::vector<ShortCell>& cells, std::vector<char>& marked);

/// Returns for each element of `before` its number in `layer`, another layer of the same plain mesh. Elements of the
/// plain mesh keep their numbers. An element of the layer becomes that in the same place of a stack as high; noIndex if
/// the stack has another height.
std::vector<Index> cellsIn(const LayerMesh& layer, const LayerMesh& before);

/// Marks points of the plain mesh that moved since `before`, or whose chain did.
std::vector<char> pointsChanged(const LayerMesh& layer, const LayerMesh& before, const Executor& executor);

} // namespace atria
