// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Executor.h"
#include "Support/Progress.h"

namespace atria {

/// What a stage needs from its surroundings.
struct RunContext
{
  const Executor& executor;
  ProgressRange progress;

  RunContext part(double first, double last) const { return {executor, progress.part(first, last)}; }
};

} // namespace atria
