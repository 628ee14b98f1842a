// SPDX-License-Identifier: GPL-3.0-or-later
/// Shapes of IFC 4 that list their points, as those of IFC 2x3 that have every point by itself.
#pragma once

#include "StepText.h"

namespace atria::model::ifc {

/// Writes triangulated and polygonal face sets as boundary representations, or surface models where they are not
/// closed, and indexed curves as polylines. Leaves alone what is damaged.
void writeTessellationsAs2x3(step::File& content);

} // namespace atria::model::ifc
