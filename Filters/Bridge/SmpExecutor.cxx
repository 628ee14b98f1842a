// SPDX-License-Identifier: GPL-3.0-or-later
#include "SmpExecutor.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

namespace atria {

namespace {

/// Returns the backend to use: VTK's own choice, but threads instead of a Sequential that nobody requested.
std::string backendInUse()
{
  const std::string chosen = vtkSMPTools::GetBackend() ? vtkSMPTools::GetBackend() : "Sequential";
  if (chosen == "Sequential" && !std::getenv("VTK_SMP_BACKEND_IN_USE"))
  {
    return "STDThread";
  }
  return chosen;
}

} // namespace

int SmpExecutor::threads() const
{
  if (backendInUse() == "Sequential")
  {
    return 1;
  }
  const int estimated = vtkSMPTools::GetEstimatedNumberOfThreads();
  const int wanted = std::string(vtkSMPTools::GetBackend()) == "Sequential"
                         ? static_cast<int>(std::thread::hardware_concurrency())
                         : estimated;
  return std::max(wanted, 1);
}

void SmpExecutor::forRanges(std::size_t count, std::size_t grain, const Body& body) const
{
  std::exception_ptr failure;
  std::mutex failureMutex;
  std::atomic<bool> failed{false};
  const std::size_t step = std::max<std::size_t>(grain, 1);
  // VTK's ranges may be longer than the grain.
  const auto guarded = [&](vtkIdType first, vtkIdType last) {
    const auto end = static_cast<std::size_t>(last);
    try
    {
      for (auto begin = static_cast<std::size_t>(first); begin < end && !failed; begin += step)
      {
        body(begin, std::min(begin + step, end));
      }
    }
    catch (...)
    {
      const std::lock_guard lock(failureMutex);
      if (!failure)
      {
        failure = std::current_exception();
        failed = true;
      }
    }
  };
  const auto run = [&] { vtkSMPTools::For(0, static_cast<vtkIdType>(count), static_cast<vtkIdType>(step), guarded); };
  const std::string backend = backendInUse();
  if (backend == vtkSMPTools::GetBackend())
  {
    run();
  }
  else
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config(threads(), backend, false), run);
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

} // namespace atria
