// SPDX-License-Identifier: GPL-3.0-or-later
/// What is made from the options as they are declared: completion for shells, and the manual page.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace atria::tool {

/// A script that completes subcommands, options and their values; `shell` is bash, zsh or fish.
std::string completionFor(const CLI::App& app, const std::string& shell);

/// The manual page, as troff.
std::string manualOf(const CLI::App& app);

} // namespace atria::tool
