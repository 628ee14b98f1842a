// SPDX-License-Identifier: GPL-3.0-or-later
/// Cells and points of a mesh with a layer that the stages of the improver look at.
#pragma once

#include "Layer/LayerTopology.h"
#include "Mesher/Improvement/ImproverStages.h"

namespace atria {

std::vector<ShortCell> badOf(const std::vector<ShortCell>& cells);

/// Those on the boundary, and those of the layer.
std::vector<char> pointsToEvaluate(const LayerMesh& layer, const Executor& executor);

/// Puts the copies of a layer where they are in another one of the same mesh, the outermost where there are several,
/// but for those above points of the wall marked in `but`.
void takeCopies(const LayerMesh& from, const std::vector<char>& but, LayerMesh& to);

/// Marks the points of cells, or those of the wall that they stand above.
void markPoints(const LayerMesh& layer, const std::vector<ShortCell>& cells, std::vector<char>& marked);

/// By element of one layer mesh its number in another one of the same plain mesh: those of the plain mesh keep theirs,
/// those of the layer have that of the element in the same place of a stack as high; noIndex for others.
std::vector<Index> cellsIn(const LayerMesh& layer, const LayerMesh& before);

/// Marks points of the plain mesh that are not where they were in another layer mesh of it, or whose chain is not.
std::vector<char> pointsChanged(const LayerMesh& layer, const LayerMesh& before, const Executor& executor);

} // namespace atria
