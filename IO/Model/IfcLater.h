// SPDX-License-Identifier: GPL-3.0-or-later
/// Rewrites constructs of IFC 4 as the same constructs of IFC 2x3.
#pragma once

#include "StepText.h"

namespace atria::model::ifc {

/// Writes as IFC 2x3 all that IFC 4 only writes in another way: shapes that list their points, special cases of
/// elements, styles, and owners and placements that are left out. Leaves constructs unknown to 2x3 unchanged.
void writeAs2x3(step::File& content);

} // namespace atria::model::ifc
