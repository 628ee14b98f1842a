// SPDX-License-Identifier: GPL-3.0-or-later
/// Sizes of the elements at each surface.
#pragma once

#include "Octree/Tree/Octree.h"
#include "Support/RankExchange.h"
#include "Support/RunContext.h"
#include "Surface/Model/SurfaceModel.h"

#include <functional>
#include <vector>

namespace atria {

/// Sizes of the octants at a surface, in model units; 0 if it has none.
struct WallSize
{
  double typical = 0.0; ///< at most a tenth of the octants are larger
  double largest = 0.0;
};

/// Returns one entry per surface, then per side of the domain. If several processes have parts of the octree, this one
/// counts the leaves for which `isOwn` is true; all get the same answer.
std::vector<WallSize> typicalSizes(const Octree& octree, const SurfaceModel& model, const RunContext& context,
                                   const std::function<bool(Index leaf)>& isOwn = {}, RankExchange& exchange = alone());

} // namespace atria
