// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over many items in parallel.
#pragma once

#include "Support/RunContext.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace atria {

/// Returns the sum of `count(i)` over [0, size). Checks for cancellation in between.
template <typename Count> std::size_t sumOver(std::size_t size, const RunContext& context, Count&& count)
{
  constexpr std::size_t grain = 4096;
  std::vector<std::size_t> parts((size + grain - 1) / grain, 0);
  context.executor.forEach(parts.size(), 1, [&](std::size_t part) {
    context.progress.check();
    for (std::size_t i = part * grain; i < std::min((part + 1) * grain, size); ++i)
    {
      parts[part] += count(i);
    }
  });
  return std::accumulate(parts.begin(), parts.end(), std::size_t{0});
}

} // namespace atria
