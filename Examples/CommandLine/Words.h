// SPDX-License-Identifier: GPL-3.0-or-later
/// Rewrites the filters' messages in terms of the command line.
#pragma once

#include <string>

namespace atria::tool {

/// Returns a message of the filters with options in place of properties.
std::string inOptions(const std::string& message);

} // namespace atria::tool
