// SPDX-License-Identifier: GPL-3.0-or-later
/// Makes completion scripts for shells and the manual page from the declared options.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace atria::tool {

/// Returns a script that completes subcommands, options and their values; `shell` is bash, zsh or fish.
std::string completionFor(const CLI::App& app, const std::string& shell);

/// Returns the manual page, as troff.
std::string manualOf(const CLI::App& app);

} // namespace atria::tool
