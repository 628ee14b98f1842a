// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs another program and captures its output.
#pragma once

#include <string>
#include <vector>

namespace atria {
class ProgressRange;
}

namespace atria::model {

/// How a program ended, and its standard output.
struct ChildResult
{
  static constexpr int crashed = -1;

  std::string output;
  int status = 0; ///< exit status, or `crashed`
};

/// Runs a program until it ends. An abort ends it. Throws Error if it cannot be started, or Aborted.
ChildResult runChild(const std::vector<std::string>& command, const ProgressRange& progress);

/// Returns the path of one of Atria's programs: in libexec/atria beside the library, or in a folder above it. Empty if
/// there is none.
std::string ownProgram(const std::string& name);

} // namespace atria::model
