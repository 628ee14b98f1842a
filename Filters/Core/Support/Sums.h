// SPDX-License-Identifier: GPL-3.0-or-later
/// Sums over many items in parallel.
#pragma once

#include "Support/Pieces.h"
#include "Support/RunContext.h"

namespace atria {

/// Returns the sum of `count(i)` over [0, size). Checks for cancellation in between.
template <typename Count> std::size_t sumOver(std::size_t size, const RunContext& context, Count&& count)
{
  const Pieces pieces(size);
  std::vector<std::size_t> sums(pieces.count, 0);
  context.executor.forEach(pieces.count, 1, [&](std::size_t piece) {
    context.progress.check();
    for (std::size_t i = pieces.begin(piece); i < pieces.end(piece); ++i)
    {
      sums[piece] += count(i);
    }
  });
  return scan(sums);
}

} // namespace atria
