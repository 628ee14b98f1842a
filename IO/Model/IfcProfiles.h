// SPDX-License-Identifier: GPL-3.0-or-later
/// Rewrites profiles of IFC that assimp does not know, or takes for others.
#pragma once

#include "StepText.h"

namespace atria::model::ifc {

/// Writes steel sections (I, L, T, U, C and Z), trapezia, ellipses and hollow profiles as outlines of straight lines.
/// assimp leaves most of them out, fills hollow ones, and puts I profiles beside their place. Rounded corners and
/// slopes are left out. Leaves damaged profiles unchanged.
void writeProfilesAsOutlines(step::File& content);

} // namespace atria::model::ifc
