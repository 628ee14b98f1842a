// SPDX-License-Identifier: GPL-3.0-or-later
/// Completes layers with a first height, and finds those that are too thin for checks of checkMesh.
#pragma once

#include "Layer/FlatLayers.h"
#include "Layer/LayerReport.h"
#include "Layer/LayerWalls.h"
#include "Mesher/MeshPort.h"
#include "Octree/Tree/MeshingContext.h"

namespace atria {

struct FittedLayers
{
  ThinLayers thin;
  /// The lowest measures of layers with a first height on flat walls, beside octants of the usual size of each.
  FlatLayers flat;
};

/// Completes requested layers with a first height by the sizes of the octants beside them (fitted()), and tells whether
/// determinants fail on all their walls. Returns what the heights bring. All processes get the same. Does nothing if no
/// first height is requested. Throws Error for one that exceeds the domain.
FittedLayers fitLayers(LayerOptions& options, const MeshPort& port, const MeshingContext& context);

} // namespace atria
