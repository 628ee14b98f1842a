// SPDX-License-Identifier: GPL-3.0-or-later
/// Executor and progress, handed together to each stage.
#pragma once

#include "Support/Executor.h"
#include "Support/Progress.h"

namespace atria {

/// Services that a stage gets from its caller.
struct RunContext
{
  const Executor& executor;
  ProgressRange progress;

  RunContext part(double first, double last) const { return {executor, progress.part(first, last)}; }
};

} // namespace atria
