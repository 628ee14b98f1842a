// SPDX-License-Identifier: GPL-3.0-or-later
/// Collects names for a message and shows a few of them.
#pragma once

#include <cstddef>
#include <string>

namespace atria::model {

class NameList
{
public:
  void add(const std::string& name)
  {
    constexpr std::size_t mostShown = 10;
    shown += count < mostShown ? (count == 0 ? "" : ", ") + name : std::string();
    more += count < mostShown ? 0 : 1;
    ++count;
  }
  bool empty() const { return count == 0; }
  /// Returns "1 element is", "2 elements are".
  std::string counted(const std::string& kind) const
  {
    return std::to_string(count) + " " + kind + (count == 1 ? " is" : "s are");
  }
  std::string text() const { return shown + (more > 0 ? " and " + std::to_string(more) + " more" : ""); }

private:
  std::string shown;
  std::size_t count = 0;
  std::size_t more = 0;
};

} // namespace atria::model
