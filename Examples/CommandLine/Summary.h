// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Report.h"

#include <string>
#include <vector>

namespace atria::tool {

/// What was made, in a dozen lines: elements by kind, validity, failed checks, worst angles, patches, repairs, what is
/// left out, time, memory, files. `report` is that of `atria mesh --report`; files and folders that are not there are
/// not told.
std::string summaryOf(const Json& report, const std::vector<std::string>& files);

} // namespace atria::tool
