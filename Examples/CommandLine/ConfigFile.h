// SPDX-License-Identifier: GPL-3.0-or-later
/// Writes the options of a subcommand as a config file.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace atria::tool {

/// Returns the options of a subcommand as a file for --config: given ones as they were given, the others as comments
/// with their defaults, all with their descriptions.
std::string configFileOf(const CLI::App& command);

} // namespace atria::tool
