// SPDX-License-Identifier: GPL-3.0-or-later
#include "SmpThreads.h"

#include <vtkSMPTools.h>

namespace atria::testing {

void useThreads(int count)
{
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(count);
}

} // namespace atria::testing
