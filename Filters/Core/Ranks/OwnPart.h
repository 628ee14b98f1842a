// SPDX-License-Identifier: GPL-3.0-or-later
/// Takes the own elements out of the plain mesh that a rank made.
#pragma once

#include "Ranks/WindowParts.h"

namespace atria {

/// Returns all own elements. All others are removed from the lists in place: most elements are own ones, and a copy
/// would hold them twice. O(elements).
WindowPart ownPart(PlainShare own, NearBoundary near, Index cutTag);

} // namespace atria
