// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Progress.h"

#include <string>
#include <thread>

class vtkAlgorithm;

namespace atria {

/// Passes progress of the core to a vtkAlgorithm, and the algorithm's abort flag to the core.
class AlgorithmProgress : public ProgressMonitor
{
public:
  /// Must be made on the thread that runs the algorithm: VTK's progress events belong there.
  explicit AlgorithmProgress(vtkAlgorithm& target);
  void report(double fraction, const char* phase) override;
  bool aborted() const override;

private:
  vtkAlgorithm& algorithm;
  std::thread::id home;
  double last = 0.0;
};

} // namespace atria
