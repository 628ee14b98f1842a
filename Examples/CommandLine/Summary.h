// SPDX-License-Identifier: GPL-3.0-or-later
/// Summarizes a run of `atria mesh` as text.
#pragma once

#include "Report.h"

#include <string>
#include <vector>

namespace atria::tool {

/// Returns the results in a dozen lines: elements by kind, validity, failed checks, worst angles, patches, repairs,
/// elements left out, time, memory, files. `report` is that of `atria mesh --report`. Missing files and folders are not
/// listed.
std::string summaryOf(const Json& report, const std::vector<std::string>& files);

} // namespace atria::tool
