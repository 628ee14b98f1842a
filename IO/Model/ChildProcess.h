// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs another program and takes what it writes.
#pragma once

#include <string>
#include <vector>

namespace atria {
class ProgressRange;
}

namespace atria::model {

/// How a program ended, and what it wrote to its standard output.
struct ChildResult
{
  static constexpr int crashed = -1;

  std::string output;
  int status = 0; ///< of its exit, or `crashed`
};

/// Runs a program until it ends. An abort ends it. Throws Error where it cannot be started, or Aborted.
ChildResult runChild(const std::vector<std::string>& command, const ProgressRange& progress);

/// The path of a program of ours: in libexec/atria beside the library, or in a folder above it; empty where there is
/// none.
std::string ownProgram(const std::string& name);

} // namespace atria::model
