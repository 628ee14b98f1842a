// SPDX-License-Identifier: GPL-3.0-or-later
/// Functions that differ between operating systems.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace atria::tool {

/// True if errors and progress go to a terminal, not to a file.
bool errorsGoToTerminal();

/// Returns the largest size of a file in bytes; none if there is no limit.
std::optional<double> largestFile();

/// Returns the peak memory of this process in bytes; 0 if the system does not report it.
long long peakMemoryBytes();

/// Returns the path of this program's file; empty if the system does not tell.
std::string programFile();

/// Puts a folder in front of those of an environment variable such as PATH.
void prependPath(const std::string& variable, const std::string& folder);

/// Continues as another program, whose exit status is that of this one. Returns, with a reason, only if it cannot be
/// started.
std::string becomeProgram(std::vector<std::string> command);

} // namespace atria::tool
