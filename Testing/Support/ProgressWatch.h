// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vtkCallbackCommand.h>
#include <vtkNew.h>

#include <functional>
#include <string>
#include <vector>

class vtkAlgorithm;

namespace atria::testing {

/// Notes what an algorithm tells of its progress while this lives, and aborts it where asked.
class ProgressWatch
{
public:
  using Condition = std::function<bool(double fraction, const std::string& text)>;

  explicit ProgressWatch(vtkAlgorithm* target, Condition abortWhen = {});
  ~ProgressWatch();
  ProgressWatch(const ProgressWatch&) = delete;
  ProgressWatch& operator=(const ProgressWatch&) = delete;

  std::vector<double> fractions;
  std::vector<std::string> texts;
  bool aborted = false;

private:
  void note(double fraction);

  vtkAlgorithm* algorithm;
  Condition condition;
  unsigned long tag = 0;
  vtkNew<vtkCallbackCommand> observer;
};

/// For a watch that aborts as soon as more than this is done.
inline ProgressWatch::Condition beyond(double limit)
{
  return [limit](double fraction, const std::string&) { return fraction > limit; };
}

} // namespace atria::testing
