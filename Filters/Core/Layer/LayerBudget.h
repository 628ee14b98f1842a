// SPDX-License-Identifier: GPL-3.0-or-later
/// Checks before meshing that the elements of layers fit the memory limit.
#pragma once

#include "Layer/LayerRules.h"
#include "Octree/Tree/Octree.h"
#include "Support/RankExchange.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

#include <functional>

namespace atria {

/// Estimates the number of elements of layers on walls, over all zones: a stack of layers at each octant that a surface
/// with layers passes through. Sheets have layers on both sides, so they get more. With `hexahedra`, both sides of all
/// surfaces and the domain's sides have the most layers of any, one at least. Counts only leaves for which `isCounted`
/// is true, if it is given.
std::size_t countLayerElements(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                               bool hexahedra, const RunContext& context,
                               const std::function<bool(Index leaf)>& isCounted = {});

/// Throws Error if an element for each octant in the domain and those that countLayerElements counts need more than
/// `memoryLimit` bytes; 0 is no limit. If several processes have parts of the octree, each counts the leaves for which
/// `isOwn` is true, and all act alike.
void checkLayerBudget(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                      bool hexahedra, std::size_t memoryLimit, const RunContext& context,
                      const std::function<bool(Index leaf)>& isOwn = {}, RankExchange& exchange = alone());

} // namespace atria
