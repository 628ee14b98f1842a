// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Ranks/WindowParts.h"

namespace atria {

/// All own elements. What else a rank's plain mesh has is taken out of its lists in place: most is own, and would be
/// there twice. O(elements).
WindowPart ownPart(PlainShare own, NearBoundary near, Index cutTag);

} // namespace atria
