// SPDX-License-Identifier: GPL-3.0-or-later
#include "AlgorithmProgress.h"

#include "VtkVersions.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>

#include <algorithm>
#include <exception>

namespace atria {

namespace {

constexpr std::chrono::milliseconds interval(100);

} // namespace

AlgorithmProgress::AlgorithmProgress(vtkAlgorithm& target)
    : algorithm(target), home(std::this_thread::get_id()), told(std::chrono::steady_clock::now())
{
}

void AlgorithmProgress::report(double fraction, const char* phase)
{
  if (std::this_thread::get_id() != home)
  {
    return;
  }
  last = std::clamp(fraction, last, 1.0);
  phase_ = phase;
  tell();
}

void AlgorithmProgress::tell() const
{
  told = std::chrono::steady_clock::now();
  algorithm.SetProgressText(phase_.c_str());
  algorithm.UpdateProgress(last);
  stop = isAskedToStop(algorithm);
}

bool AlgorithmProgress::aborted() const
{
  if (std::this_thread::get_id() == home)
  {
    if (std::chrono::steady_clock::now() - told > interval)
    {
      tell();
    }
    else if (algorithm.GetAbortExecute())
    {
      stop = true;
    }
  }
  return stop;
}

AlgorithmRun::AlgorithmRun(vtkAlgorithm& algorithm)
    : progress(algorithm), executor(threads, progress), context{executor, ProgressRange(progress)}
{
}

void clearOutputs(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject::GetData(outputs, i)->Initialize();
  }
}

int runFilter(vtkAlgorithm& algorithm, vtkInformationVector* outputs, const char* task,
              const std::function<void(const RunContext&)>& work)
{
  try
  {
    const AlgorithmRun run(algorithm);
    work(run.context);
    return 1;
  }
  catch (const Aborted&)
  {
    clearOutputs(outputs);
    markAborted(outputs);
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(&algorithm, << task << error.what());
  }
  clearOutputs(outputs);
  return 0;
}

void markAborted(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    outputs->GetInformationObject(i)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

} // namespace atria
