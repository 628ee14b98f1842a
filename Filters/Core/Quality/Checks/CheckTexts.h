// SPDX-License-Identifier: GPL-3.0-or-later
/// What users are told of checks that fail.
#pragma once

#include "Quality/Checks/MeshChecks.h"

#include <string>
#include <vector>

namespace atria {

/// What can fail in a check: "cells", "faces", "points" or "mesh".
const char* nameOf(MeshPart part);

/// What to do where the check fails, in the words of the filters' properties; empty for a check that is no error.
const char* adviceFor(const MeshCheck& check);

/// For each check that counts as failed: its name, how many cells or faces fail it, the place of the first of them, and
/// what to do.
std::vector<std::string> failureTexts(const MeshVerdict& verdict);

} // namespace atria
