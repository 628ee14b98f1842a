// SPDX-License-Identifier: GPL-3.0-or-later
/// Rewrites shapes of IFC 4 that list their points as shapes of IFC 2x3, which have every point by itself.
#pragma once

#include "StepText.h"

namespace atria::model::ifc {

/// Writes triangulated and polygonal face sets as boundary representations, or as surface models if they are not
/// closed, and indexed curves as polylines. Leaves damaged shapes unchanged.
void writeTessellationsAs2x3(step::File& content);

} // namespace atria::model::ifc
