// SPDX-License-Identifier: GPL-3.0-or-later
#include "SmpThreads.h"

#include <vtkSMPTools.h>

#include <string>

namespace atria::testing {

void useThreads(int count)
{
  if (std::string(vtkSMPTools::GetBackend()) == "Sequential")
  {
    vtkSMPTools::SetBackend("STDThread");
  }
  vtkSMPTools::Initialize(count);
}

} // namespace atria::testing
