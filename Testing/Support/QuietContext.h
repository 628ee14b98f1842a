// SPDX-License-Identifier: GPL-3.0-or-later
/// The surroundings of runs of the core that nobody watches.
#pragma once

#include "Support/RunContext.h"

namespace atria::testing {

/// `executor` must outlive the run.
inline RunContext quietContext(const Executor& executor)
{
  static SilentMonitor silent;
  return {executor, ProgressRange(silent)};
}

/// On one thread.
inline RunContext quietContext()
{
  static const SerialExecutor serial;
  return quietContext(serial);
}

} // namespace atria::testing
