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
  /// Ends a stage that began at the last call, or when the clock was made.
  void lap(std::string stage)
  {
    const auto now = std::chrono::steady_clock::now();
    stages_.emplace_back(std::move(stage), std::chrono::duration<double>(now - last).count());
    last = now;
  }
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

private:
  std::chrono::steady_clock::time_point last = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> stages_;
};

} // namespace atria
