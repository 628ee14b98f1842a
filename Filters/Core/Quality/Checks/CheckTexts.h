// SPDX-License-Identifier: GPL-3.0-or-later
/// Texts for users about checks that fail.
#pragma once

#include "Quality/Checks/MeshChecks.h"

#include <string>
#include <vector>

namespace atria {

/// Returns the name of the parts that a check judges: "cells", "faces", "points" or "mesh".
const char* nameOf(MeshPart part);

/// Returns advice for a check that fails, in terms of the filters' properties; empty for a check that is no error.
const char* adviceFor(const MeshCheck& check);

/// Returns one text per check that counts as failed: its name, the number of cells or faces that fail it, the position
/// of the first one, and advice.
std::vector<std::string> failureTexts(const MeshVerdict& verdict);

} // namespace atria
