// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <algorithm>

namespace atria {

/// Different numbers, no more than `most`, which are few.
template <std::size_t most> class FewNumbers
{
public:
  /// False where the number would be one too many.
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
