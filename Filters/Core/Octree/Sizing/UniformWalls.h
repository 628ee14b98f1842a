// SPDX-License-Identifier: GPL-3.0-or-later
/// Keeps octants of one size at and near each connected piece of surface.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// Refines further until no octant beside one that holds a surface is larger, and none within two octants of it
/// smaller, and balances in families (see balance()). So octants that are split (SplitOctants) do not touch any that
/// hold a surface. Octants at a surface become as small as the smallest near its connected pieces; sides of a turned
/// domain do not count. Makes an octree for each level of refinement it adds.
void makeUniformAtWalls(RefinedSets& refined, const SurfaceModel& model, const GridFrame& frame, int cellsPerLevel,
                        const RunContext& context);

} // namespace atria
