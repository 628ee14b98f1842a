// SPDX-License-Identifier: GPL-3.0-or-later
/// Numbers chosen items in their order.
#pragma once

#include "Support/Pieces.h"

namespace atria {

/// Sets `numbers` to consecutive numbers for the items for which `isChosen` is true, and to noIndex for the others.
/// Returns the number of chosen items. `numbers` has one entry per item; `isChosen` is called twice for each.
template <typename IsChosen>
Index numberInOrder(std::vector<Index>& numbers, const Executor& executor, IsChosen&& isChosen)
{
  const Pieces pieces(numbers.size());
  std::vector<Index> firsts(pieces.count, 0);
  executor.forEach(pieces.count, 4, [&](std::size_t piece) {
    for (std::size_t i = pieces.begin(piece); i < pieces.end(piece); ++i)
    {
      firsts[piece] += isChosen(i) ? 1 : 0;
    }
  });
  const Index count = scan(firsts);
  executor.forEach(pieces.count, 4, [&](std::size_t piece) {
    Index next = firsts[piece];
    for (std::size_t i = pieces.begin(piece); i < pieces.end(piece); ++i)
    {
      numbers[i] = isChosen(i) ? next++ : noIndex;
    }
  });
  return count;
}

} // namespace atria
