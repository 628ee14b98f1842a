// SPDX-License-Identifier: GPL-3.0-or-later
/// Runs the core within a vtkAlgorithm: progress, abort, threads and errors.
#pragma once

#include "SmpExecutor.h"
#include "Support/Progress.h"
#include "Support/RunContext.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>

class vtkAlgorithm;
class vtkInformationVector;

namespace atria {

/// Passes progress of the core to a vtkAlgorithm, and the algorithm's abort flag to the core.
class AlgorithmProgress : public ProgressMonitor
{
public:
  /// Must be made on the thread that runs the algorithm: VTK's progress events belong there.
  explicit AlgorithmProgress(vtkAlgorithm& target);
  void report(double fraction, const char* phase) override;
  /// True if the algorithm must stop. On the algorithm's thread, it repeats the last progress event every tenth of a
  /// second: ParaView's abort button, for example, may have no other occasion to request the stop.
  bool aborted() const override;

private:
  void tell() const;

  vtkAlgorithm& algorithm;
  std::thread::id home;
  double last = 0.0;
  std::string phase_;
  mutable std::chrono::steady_clock::time_point told;
  mutable std::atomic<bool> stop{false};
};

/// Progress and threads of a filter, for one run of the core.
class AlgorithmRun
{
public:
  /// Must be made on the thread that runs the algorithm.
  explicit AlgorithmRun(vtkAlgorithm& algorithm);
  AlgorithmRun(const AlgorithmRun&) = delete;
  AlgorithmRun& operator=(const AlgorithmRun&) = delete;

private:
  AlgorithmProgress progress;
  SmpExecutor threads;
  AbortableExecutor executor;

public:
  const RunContext context;
};

/// Empties all outputs, including the field data that the pipeline copied from the input.
void clearOutputs(vtkInformationVector* outputs);

/// Runs `work` and returns the result of RequestData. Exceptions of the core, except Aborted, become errors of the
/// filter with `task` in front of the text. Errors and aborts leave all outputs empty; an abort also marks them as
/// markAborted() does.
int runFilter(vtkAlgorithm& algorithm, vtkInformationVector* outputs, const char* task,
              const std::function<void(const RunContext&)>& work);

/// Makes the pipeline run the filter again at the next update, although nothing was modified: its outputs are not the
/// requested ones.
void markAborted(vtkInformationVector* outputs);

} // namespace atria
