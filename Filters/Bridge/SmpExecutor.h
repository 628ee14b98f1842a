// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs the core's loops on VTK's threads.
#pragma once

#include "Support/Executor.h"

namespace atria {

/// Runs loops of the core on vtkSMPTools. VTK's number of threads is respected; where VTK's backend is
/// Sequential (ParaView's default) and more than one thread is allowed, STDThread is used for the loop.
class SmpExecutor : public Executor
{
public:
  int threads() const override;
  void forRanges(std::size_t count, std::size_t grain, const Body& body) const override;
};

} // namespace atria
