// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Layer/LayerRules.h"
#include "Octree/Tree/Octree.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

#include <functional>

namespace atria {

/// Elements of the mesh of an octree with layers on walls, all zones counted: the octants in the domain, and a stack of
/// layers at each of those that surfaces with layers pass through. Sheets have layers on both sides, and so more.
/// Counts only leaves that `isCounted`, if that is given.
std::size_t elementsWithLayers(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                               const RunContext& context, const std::function<bool(Index leaf)>& isCounted = {});

/// Throws Error where so many elements do not fit the bytes of `memoryLimit`; 0 is no limit.
void checkLayerBudget(std::size_t elements, std::size_t memoryLimit);

/// The same of these elements.
void checkLayerBudget(const Octree& octree, const SurfaceModel& model, const std::vector<LayerRule>& rules,
                      std::size_t memoryLimit, const RunContext& context);

} // namespace atria
