// SPDX-License-Identifier: GPL-3.0-or-later
/// Completes layers with a first height, and finds those that are too thin for checks of checkMesh.
#pragma once

#include "Layer/FlatLayers.h"
#include "Layer/LayerReport.h"
#include "Layer/LayerWalls.h"
#include "Mesher/MeshPort.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

/// Completes requested layers with a first height by the sizes of the elements beside them (fitted()), and tells
/// whether determinants fail on all their walls. Returns which checks fail on any wall with such heights, and a note on
/// them. All processes get the same. Does nothing if no first height is requested.
ThinLayers fitLayers(LayerOptions& options, const MeshPort& port, const MeshingContext& context);

/// Returns the lowest measures that layers with a first height have on flat walls, by the sizes of octants: all
/// processes get the same. `options` were completed by fitLayers().
FlatLayers flatLayersOfAll(const LayerOptions& options, const MeshPort& port, const MeshingContext& context);

} // namespace atria
