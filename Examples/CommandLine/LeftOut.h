// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Report.h"

#include <string>

namespace atria::tool {

class Console;

/// Tells which spaces of the model are not in the mesh, as nothing opens them: rooms as warnings with a seed for each,
/// insides of solids and spaces too narrow for the sizes summed up as notes. `zones` is from zonesOf.
void tellLeftOut(const Json& zones, const std::string& model, Console& console);

} // namespace atria::tool
