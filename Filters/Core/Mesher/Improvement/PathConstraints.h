// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Mesher/Improvement/LayerImprover.h"
#include "Optimize/Constraints/LayerConstraints.h"

namespace atria {

/// Where points of the layer as it is now may go.
struct LayerImprover::Constraints
{
  explicit Constraints(const LayerImprover& owner)
      : model(owner.context_, owner.classification_, owner.layer_.mesh.points, owner.vertexOf_),
        layer(owner.layer_, owner.walls_, owner.options_, owner.vertexOf_, owner.letGo_, model)
  {
  }

  ModelConstraints model;
  LayerConstraints layer;
};

} // namespace atria
