// SPDX-License-Identifier: GPL-3.0-or-later
/// Counts what the ranks before this one have, for numbers that run through all ranks.
#pragma once

#include "Support/RankExchange.h"

namespace atria {

/// Counts of what the ranks before this one have, and of what all have.
struct GlobalCount
{
  std::size_t before;
  std::size_t all;
};

/// All ranks call it at the same time.
inline GlobalCount countBefore(std::size_t own, RankExchange& exchange)
{
  GlobalCount count{0, 0};
  const std::vector<std::size_t> counts = gatherAll(exchange, own);
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    count.before += rank < static_cast<std::size_t>(exchange.rank()) ? counts[rank] : 0;
    count.all += counts[rank];
  }
  return count;
}

} // namespace atria
