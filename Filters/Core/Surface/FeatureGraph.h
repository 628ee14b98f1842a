// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Surface/SurfaceModel.h"

namespace atria {

/// Fills `charts`, `featureEdges` and `corners` of a model whose points, triangles, surface ids and domain sides are
/// set.
void findFeatures(SurfaceModel& model, const GridFrame& frame, const FeatureOptions& options);

} // namespace atria
