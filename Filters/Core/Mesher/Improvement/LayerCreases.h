// SPDX-License-Identifier: GPL-3.0-or-later
/// Adds crease sheets to a mesh whose octants are all of one size.
#pragma once

#include "Mesher/Improvement/ImproverState.h"

namespace atria {

/// Adds sheets of hexahedra along creases of a uniform mesh, where no hexahedron could be good otherwise. Tries several
/// widths and takes the one with the best worst hexahedron. The mesh stays as it is if no width gives a valid mesh that
/// is as good.
void addCreaseSheets(ImproverState& state);

} // namespace atria
