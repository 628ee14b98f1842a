// SPDX-License-Identifier: GPL-3.0-or-later
/// Reports how far the requested layers were built.
#pragma once

#include "Dual/Mesh/OwnElements.h"
#include "Layer/LayerReport.h"
#include "Layer/LayerTopology.h"

namespace atria {

/// Returns the size of the elements beside walls, one entry per point of the mesh that layers were grown from, in model
/// units. It determines the thickness of layers without a height of their own.
std::vector<double> sizesBesideWalls(const DualMesh& plain, const LayerWalls& walls, const RunContext& context);

/// Reports the layers of a mesh. `walls` and `sizes` are those of the mesh the layers were grown from.
/// \param part  Divides the elements of the mesh with layers. Surfaces are reported as of all processes, faces as of
///              this one.
LayerReport reportLayers(const LayerMesh& layer, const LayerWalls& walls, const std::vector<double>& sizes,
                         const LayerOptions& options, const std::vector<std::string>& surfaceNames,
                         const OwnElements& part = {});

} // namespace atria
