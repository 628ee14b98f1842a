// SPDX-License-Identifier: GPL-3.0-or-later
/// Adds crease sheets to a mesh whose octants are all of one size.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

namespace atria {

/// Gives a uniform mesh crease sheets of hexahedra along creases, where else no hexahedron could be good. Of the widths
/// tried the one with the best worst hexahedron is taken. Where none becomes valid, or that is worse than without
/// crease sheets, the mesh stays as it is.
void addCreaseSheets(ImproverState& state);

} // namespace atria
