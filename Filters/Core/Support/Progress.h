// SPDX-License-Identifier: GPL-3.0-or-later
/// Port through which the core reports its progress and learns that it should stop.
#pragma once

#include "Support/Error.h"

namespace atria {

/// Implemented by the caller. The core calls report() from the thread that runs a stage; aborted() may be
/// called from any thread and must be cheap.
class ProgressMonitor
{
public:
  virtual ~ProgressMonitor() = default;
  /// `fraction` in [0, 1], never falling within one run; `phase` is a short text such as "Balancing".
  virtual void report(double fraction, const char* phase) = 0;
  virtual bool aborted() const = 0;
};

/// Progress nobody listens to.
class SilentMonitor : public ProgressMonitor
{
public:
  void report(double, const char*) override {}
  bool aborted() const override { return false; }
};

/// Part [begin, end] of a monitor's range, so that a stage can report 0 to 1 of its own.
class ProgressRange
{
public:
  explicit ProgressRange(ProgressMonitor& target, double first = 0.0, double last = 1.0)
      : monitor(&target), begin(first), end(last)
  {
  }

  ProgressRange part(double first, double last) const
  {
    return ProgressRange(*monitor, begin + first * (end - begin), begin + last * (end - begin));
  }

  /// Reports, and throws Aborted if the caller wants to stop.
  void report(double fraction, const char* phase) const
  {
    monitor->report(begin + fraction * (end - begin), phase);
    check();
  }

  bool isAborted() const { return monitor->aborted(); }

  void check() const
  {
    if (isAborted())
    {
      throw Aborted();
    }
  }

private:
  ProgressMonitor* monitor;
  double begin;
  double end;
};

/// Passes on only the request to stop of another monitor, for work that is one of many tasks at the same time.
class StopMonitor : public ProgressMonitor
{
public:
  explicit StopMonitor(const ProgressRange& progress) : progress_(progress) {}
  void report(double, const char*) override {}
  bool aborted() const override { return progress_.isAborted(); }

private:
  ProgressRange progress_;
};

} // namespace atria
