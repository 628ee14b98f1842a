// SPDX-License-Identifier: GPL-3.0-or-later
/// Clock that measures the wall time of stages.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace atria {

/// Wall time of named stages in seconds, in the order in which they first ended.
class StageClock
{
public:
  /// Ends a stage that began at the last call, or when the clock was made. The time is added if a stage of that name
  /// ended before.
  void lap(const std::string& stage)
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last).count();
    last = now;
    for (auto& [name, sum] : stages_)
    {
      if (name == stage)
      {
        sum += seconds;
        return;
      }
    }
    stages_.emplace_back(stage, seconds);
  }
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

private:
  std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> stages_;
};

} // namespace atria
