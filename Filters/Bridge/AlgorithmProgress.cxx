// SPDX-License-Identifier: GPL-3.0-or-later
#include "AlgorithmProgress.h"

#include <vtkAlgorithm.h>
#include <vtkVersion.h>

#include <algorithm>

namespace atria {

AlgorithmProgress::AlgorithmProgress(vtkAlgorithm& target) : algorithm(target), home(std::this_thread::get_id()) {}

void AlgorithmProgress::report(double fraction, const char* phase)
{
  if (std::this_thread::get_id() != home)
  {
    return;
  }
  last = std::clamp(fraction, last, 1.0);
  algorithm.SetProgressText(phase);
  algorithm.UpdateProgress(last);
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  algorithm.CheckAbort();
#endif
}

bool AlgorithmProgress::aborted() const
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 2, 20220823)
  return algorithm.GetAbortOutput() || algorithm.GetAbortExecute();
#else
  return algorithm.GetAbortExecute() != 0;
#endif
}

} // namespace atria
