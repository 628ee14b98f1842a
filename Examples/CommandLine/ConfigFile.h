// SPDX-License-Identifier: GPL-3.0-or-later
/// The option --write-config, which writes the options of a subcommand as a config file.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace atria::tool {

/// Returns the options of a subcommand as a file for --config: given ones as they were given, the others as comments
/// with their defaults, all with their descriptions.
std::string configFileOf(const CLI::App& command);

/// Declares --write-config, which names `file`. `instead` says what the subcommand does not do then.
void declareConfigFile(CLI::App& command, std::string& file, const char* instead);
/// Writes the config file if --write-config named one. Returns false if it did not. Throws Failure for a name that does
/// not end in .toml, and if the file cannot be written.
bool writesConfigFile(const CLI::App& command, const std::string& file);

} // namespace atria::tool
