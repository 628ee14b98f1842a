// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Dual/Mesh/MetSides.h"
#include "Mesher/ModelOptions.h"

namespace atria {

/// A sentence where no surface but the ground has a face in the mesh, though there are others.
std::vector<std::string> warningsOfLostModel(const TriangleSurface& surface, const ModelOptions& options,
                                             const GridFrame& frame, const std::vector<MetSides>& met);

} // namespace atria
