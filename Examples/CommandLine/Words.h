// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace atria::tool {

/// A message of the filters in the words of the command line: options where it names properties.
std::string inOptions(const std::string& message);

} // namespace atria::tool
