// SPDX-License-Identifier: GPL-3.0-or-later
// A file of its own, as VTK 9.1's vtkSMPTools.h is not C++20.
#include <vtkSMPTools.h>

/// 0 is all cores.
void useThreads(int count) { vtkSMPTools::Initialize(count); }
