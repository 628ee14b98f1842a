// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/Model/SurfaceModel.h"

namespace atria {

/// Fills `charts`, `featureEdges`, `curves` and `corners` of a model whose points, triangles, surface ids and domain
/// sides are set.
void findFeatures(SurfaceModel& model, const GridFrame& frame, const FeatureOptions& options, const Executor& executor);

/// Per curve, the surfaces of the charts that meet there, sorted, each once.
std::vector<std::vector<Index>> surfacesOfCurves(const SurfaceModel& model);

} // namespace atria
