// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"

#include <vtkSMPTools.h>

namespace atria {
namespace tool {

void setThreads(int count) { vtkSMPTools::Initialize(count); }

int threadsInUse() { return vtkSMPTools::GetEstimatedNumberOfThreads(); }

} // namespace tool
} // namespace atria
