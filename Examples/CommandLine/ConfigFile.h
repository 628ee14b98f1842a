// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace atria::tool {

/// The options of a subcommand as a file for --config: what was given as it was, the others as comments with their
/// defaults, all with what they mean.
std::string configFileOf(const CLI::App& command);

} // namespace atria::tool
