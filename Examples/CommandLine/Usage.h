// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace CLI {
class App;
class Error;
} // namespace CLI

namespace atria::tool {

/// What CLI11 found wrong with the command line, in one message; with the option, subcommand or key of a config file
/// that was likely meant.
std::string usageMessage(const CLI::App* app, const CLI::Error& error);

} // namespace atria::tool
