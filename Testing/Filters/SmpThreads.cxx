// SPDX-License-Identifier: GPL-3.0-or-later
#include "SmpThreads.h"

#include <vtkSMPTools.h>

namespace atria::testing {

void useThreads(int count)
{
  if (std::string(vtkSMPTools::GetBackend()) == "Sequential")
  {
    vtkSMPTools::SetBackend("STDThread");
  }
  vtkSMPTools::Initialize(count);
}

SmpBackend::SmpBackend(const char* name) : before(vtkSMPTools::GetBackend()) { vtkSMPTools::SetBackend(name); }

SmpBackend::~SmpBackend() { vtkSMPTools::SetBackend(before.c_str()); }

} // namespace atria::testing
