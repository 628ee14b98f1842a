// SPDX-License-Identifier: GPL-3.0-or-later
/// What operating systems answer each in their own way.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace atria::tool {

/// Whether errors and progress go to a terminal, not to a file.
bool errorsGoToTerminal();

/// Bytes that a file may have at most; none where there is no such limit.
std::optional<double> largestFile();

/// Of memory that this process has taken so far; 0 where the system does not tell.
long long peakMemoryBytes();

/// Adds a folder in front of those of an environment variable such as PATH.
void prependPath(const std::string& variable, const std::string& folder);

/// Goes on as another program, whose exit status is that of this one. Returns, with a reason, only where it cannot be
/// started.
std::string becomeProgram(std::vector<std::string> command);

} // namespace atria::tool
