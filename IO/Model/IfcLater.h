// SPDX-License-Identifier: GPL-3.0-or-later
/// What IFC 4 writes in another way than IFC 2x3.
#pragma once

#include "StepText.h"

namespace atria::model::ifc {

/// Writes as IFC 2x3 what IFC 4 only writes in another way: shapes that list their points, special cases of elements,
/// styles, and owners and placements that are left out. Leaves alone what 2x3 does not have.
void writeAs2x3(step::File& content);

} // namespace atria::model::ifc
