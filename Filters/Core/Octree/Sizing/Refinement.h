// SPDX-License-Identifier: GPL-3.0-or-later
/// Builds octrees whose leaves know their pieces of the model.
#pragma once

#include "Octree/Sizing/Sizing.h"

namespace atria {

/// Builds the balanced octree of a model. In the domain all octants are refined to the top level, octants with a
/// surface to the mid level, and octants with a feature or with surfaces that do not meet inside them to the finest.
/// Leaves know their pieces of the model. `sizing` adds further rules; see sizeOctants.
Octree buildOctree(const SurfaceModel& model, const GridFrame& frame, const SizingOptions& sizing,
                   const RunContext& context);

/// The same from octants sized before.
Octree buildOctree(const SurfaceModel& model, const GridFrame& frame, const SizedOctants& sized,
                   const RunContext& context);

/// Gives the leaves of an octree from elsewhere their pieces of the model.
void locateModel(Octree& octree, const SurfaceModel& model, const RunContext& context);

} // namespace atria
