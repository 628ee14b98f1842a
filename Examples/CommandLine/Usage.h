// SPDX-License-Identifier: GPL-3.0-or-later
/// Turns CLI11's errors into messages for the user.
#pragma once

#include <string>

namespace CLI {
class App;
class Error;
} // namespace CLI

namespace atria::tool {

/// Returns CLI11's complaint about the command line in one message, with the option, subcommand or key of a config file
/// that was likely meant.
std::string usageMessage(const CLI::App* app, const CLI::Error& error);

} // namespace atria::tool
