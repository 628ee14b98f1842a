// SPDX-License-Identifier: GPL-3.0-or-later
/// Port through which the core runs loops on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace atria {

/// Runs the pieces of a loop. Every algorithm of the core gives the same bits whatever the executor does:
/// a piece writes only what its own range owns.
class Executor
{
public:
  using Body = std::function<void(std::size_t begin, std::size_t end)>;

  virtual ~Executor() = default;
  virtual int threads() const = 0;

  /// Calls `body` on disjoint ranges that cover [0, count), each at most `grain` long, and waits for all.
  /// An exception thrown by a piece reaches the caller after the others have ended.
  virtual void forRanges(std::size_t count, std::size_t grain, const Body& body) const = 0;

  /// Calls `body(i)` for every i in [0, count).
  template <typename F> void forEach(std::size_t count, std::size_t grain, F&& body) const
  {
    forRanges(count, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
      {
        body(i);
      }
    });
  }
};

/// Runs loops on the calling thread.
class SerialExecutor : public Executor
{
public:
  int threads() const override { return 1; }
  void forRanges(std::size_t count, std::size_t grain, const Body& body) const override;
};

class ProgressMonitor;

/// Runs loops on another executor, and throws Aborted soon after a monitor says to stop. The monitor is asked before
/// every range. The thread that runs the loop also asks from time to time, even if the other executor lets that thread
/// wait.
class AbortableExecutor : public Executor
{
public:
  AbortableExecutor(const Executor& executor, const ProgressMonitor& monitor) : executor_(executor), monitor_(monitor)
  {
  }
  int threads() const override { return executor_.threads(); }
  void forRanges(std::size_t count, std::size_t grain, const Body& body) const override;

private:
  const Executor& executor_;
  const ProgressMonitor& monitor_;
};

/// A fixed number of std::threads; for use without VTK.
class ThreadExecutor : public Executor
{
public:
  explicit ThreadExecutor(int numberOfThreads);
  int threads() const override { return count_; }
  void forRanges(std::size_t count, std::size_t grain, const Body& body) const override;

private:
  int count_;
};

} // namespace atria
