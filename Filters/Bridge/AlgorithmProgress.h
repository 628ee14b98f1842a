// SPDX-License-Identifier: GPL-3.0-or-later
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
  /// Asked on the algorithm's thread, repeats the last progress event every tenth of a second: who wants to abort, such
  /// as ParaView's button, may have no other occasion to say so.
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

/// What the core needs from a filter for one run.
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

/// Leaves nothing in any output, nor the field data of the input that the pipeline has put there.
void clearOutputs(vtkInformationVector* outputs);

/// Does the work of RequestData and returns what that has to return. What the core throws is told behind `task`, as an
/// error of the filter, but for Aborted. Both leave all outputs empty; an abort also marks them as markAborted() does.
int runFilter(vtkAlgorithm& algorithm, vtkInformationVector* outputs, const char* task,
              const std::function<void(const RunContext&)>& work);

/// Has the pipeline run the filter again at the next update, although nothing was modified: its outputs are not what
/// was asked for.
void markAborted(vtkInformationVector* outputs);

} // namespace atria
