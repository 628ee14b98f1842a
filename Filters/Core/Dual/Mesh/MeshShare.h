// SPDX-License-Identifier: GPL-3.0-or-later
/// Divides a mesh among ranks so that sums count each element once.
#pragma once

#include "Support/ExactSum.h"
#include "Support/RankExchange.h"
#include "Support/Types.h"

#include <functional>

namespace atria {

/// Elements that a rank counts of a mesh that several ranks have. One process counts all.
struct MeshShare
{
  std::function<bool(Index element)> isOwn;
  /// All ranks sum up at the same time then.
  RankExchange* exchange = nullptr;

  bool counts(Index element) const { return !isOwn || isOwn(element); }
};

/// The sums over all ranks of lists that are equally long; `own` itself in one process.
inline std::vector<ExactSum> sumOverRanks(const MeshShare& share, std::vector<ExactSum> own)
{
  if (!share.exchange)
  {
    return own;
  }
  std::vector<ExactSum> sums(own.size());
  for (const std::vector<ExactSum>& some : gatherAll(*share.exchange, own))
  {
    for (std::size_t i = 0; i < sums.size(); ++i)
    {
      sums[i].add(some[i]);
    }
  }
  return sums;
}

} // namespace atria
