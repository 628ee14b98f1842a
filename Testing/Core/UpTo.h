// SPDX-License-Identifier: GPL-3.0-or-later
/// The numbers from 0 on, in their order.
#pragma once

#include "Support/Types.h"

#include <numeric>
#include <vector>

namespace atria::testing {

/// Returns `count` numbers.
inline std::vector<Index> upTo(std::size_t count)
{
  std::vector<Index> numbers(count);
  std::iota(numbers.begin(), numbers.end(), Index{0});
  return numbers;
}

} // namespace atria::testing
