// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/Executor.h"

#include "Support/Progress.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace atria {

void SerialExecutor::forRanges(std::size_t count, std::size_t grain, const Body& body) const
{
  const std::size_t step = std::max<std::size_t>(grain, 1);
  for (std::size_t begin = 0; begin < count; begin += step)
  {
    body(begin, std::min(begin + step, count));
  }
}

void AbortableExecutor::forRanges(std::size_t count, std::size_t grain, const Body& body) const
{
  const std::size_t rangesAtOnce = 16 * std::max<std::size_t>(4, static_cast<std::size_t>(executor_.threads()));
  const auto check = [this] {
    if (monitor_.aborted())
    {
      throw Aborted();
    }
  };
  const std::size_t slice = rangesAtOnce * std::max<std::size_t>(grain, 1);
  for (std::size_t first = 0; first < count; first += slice)
  {
    check();
    executor_.forRanges(std::min(slice, count - first), grain, [&](std::size_t begin, std::size_t end) {
      check();
      body(first + begin, first + end);
    });
  }
}

ThreadExecutor::ThreadExecutor(int numberOfThreads) : count_(std::max(numberOfThreads, 1)) {}

void ThreadExecutor::forRanges(std::size_t count, std::size_t grain, const Body& body) const
{
  const std::size_t step = std::max<std::size_t>(grain, 1);
  const std::size_t pieces = (count + step - 1) / step;
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failureMutex;
  const auto work = [&] {
    for (std::size_t piece = next++; piece < pieces; piece = next++)
    {
      try
      {
        body(piece * step, std::min(piece * step + step, count));
      }
      catch (...)
      {
        const std::lock_guard lock(failureMutex);
        if (!failure)
        {
          failure = std::current_exception();
        }
      }
    }
  };
  std::vector<std::thread> workers;
  for (std::size_t i = 1; i < std::min<std::size_t>(count_, pieces); ++i)
  {
    workers.emplace_back(work);
  }
  work();
  for (std::thread& worker : workers)
  {
    worker.join();
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

} // namespace atria
