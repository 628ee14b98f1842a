// SPDX-License-Identifier: GPL-3.0-or-later
/// A small set of numbers in an array of fixed size.
#pragma once

#include "Support/Types.h"

#include <algorithm>

namespace atria {

/// Set of at most `most` distinct numbers. The search is linear, so `most` should be small.
template <std::size_t most> class FewNumbers
{
public:
  /// Adds a number unless it is there already. Returns false if there is no room for it.
  bool add(Index number)
  {
    const auto end = numbers_.begin() + count_;
    if (std::find(numbers_.begin(), end, number) != end)
    {
      return true;
    }
    if (end == numbers_.end())
    {
      return false;
    }
    numbers_[count_++] = number;
    return true;
  }

private:
  std::array<Index, most> numbers_;
  std::size_t count_ = 0;
};

} // namespace atria
