// SPDX-License-Identifier: GPL-3.0-or-later
/// Warnings and notes of a reader, collected for the user.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace atria::scene {

/// Warnings in the order they came up, and notes on actions that need no attention. All warnings are counted; the first
/// `keptAtMost` of either are kept.
class Diagnostics
{
public:
  static constexpr std::size_t keptAtMost = 1000;

  void warn(std::string text)
  {
    ++total;
    if (kept.size() < keptAtMost)
    {
      kept.push_back(std::move(text));
    }
  }
  void note(std::string text)
  {
    if (remarks.size() < keptAtMost)
    {
      remarks.push_back(std::move(text));
    }
  }
  const std::vector<std::string>& notes() const { return remarks; }
  const std::vector<std::string>& texts() const { return kept; }
  std::size_t count() const { return total; }

private:
  std::vector<std::string> kept;
  std::vector<std::string> remarks;
  std::size_t total = 0;
};

} // namespace atria::scene
