// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace atria {

/// Wall time of named stages, in the order in which they ended.
class StageClock
{
public:
  /// Ends a stage that began at the last call, or when the clock was made. A stage that ended before goes on.
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
