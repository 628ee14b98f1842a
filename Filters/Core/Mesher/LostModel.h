// SPDX-License-Identifier: GPL-3.0-or-later
/// Warns if a mesh has lost its model.
#pragma once

#include "Dual/Mesh/MetSides.h"

#include <string>
#include <vector>

namespace atria {

/// Returns a sentence if no surface but the ground has a face in the mesh, though there are others.
/// \param isGround  One flag per surface.
/// \param met       One entry per surface; further entries are ignored.
std::vector<std::string> warningsOfLostModel(const std::vector<char>& isGround, double sizeMin,
                                             const std::vector<MetSides>& met);

} // namespace atria
