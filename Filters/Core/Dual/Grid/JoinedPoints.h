// SPDX-License-Identifier: GPL-3.0-or-later
/// Joins the grid points of a process to sets.
#pragma once

#include "Dual/Grid/GridPart.h"
#include "Support/NumberInOrder.h"
#include "Support/RunContext.h"
#include "Support/UnionFind.h"

#include <algorithm>
#include <utility>

namespace atria {

/// Returns the sets of own points that are joined to each other. The result does not depend on threads.
/// \param nextTo  As of GridPart::join(); it must be symmetric. Several threads call it.
template <typename NextTo> PointSets joinOwn(const IndexRange& own, const NextTo& nextTo, const RunContext& context)
{
  // Points of a piece are joined with each other first, by all threads.
  constexpr std::size_t length = 16384;
  const std::size_t count = own.size();
  UnionFind joined(count);
  std::vector<std::vector<std::pair<Index, Index>>> between((count + length - 1) / length);
  context.executor.forEach(between.size(), 1, [&](std::size_t piece) {
    context.progress.check();
    const std::size_t begin = piece * length;
    const std::size_t end = std::min(begin + length, count);
    for (std::size_t point = begin; point < end; ++point)
    {
      for (int direction = 1; direction < 6; direction += 2)
      {
        const Index next = nextTo(own.begin + static_cast<Index>(point), direction);
        if (next == noIndex || !own.contains(next))
        {
          continue;
        }
        const Index other = next - own.begin;
        if (other >= begin && other < end)
        {
          joined.join(static_cast<Index>(point), other);
        }
        else
        {
          between[piece].emplace_back(static_cast<Index>(point), other);
        }
      }
    }
  });
  for (const auto& pairs : between)
  {
    context.progress.check();
    for (const auto& [a, b] : pairs)
    {
      joined.join(a, b);
    }
  }
  PointSets sets{std::vector<Index>(count)};
  context.executor.forEach(count, Pieces::length,
                           [&](std::size_t i) { sets.ofOwn[i] = joined.find(static_cast<Index>(i)); });
  joined.reset(0);
  std::vector<Index> numbers(count); // set numbers, at the first point of each set
  sets.count = numberInOrder(numbers, context.executor, [&](std::size_t i) { return sets.ofOwn[i] == i; });
  context.executor.forEach(count, Pieces::length, [&](std::size_t i) { sets.ofOwn[i] = numbers[sets.ofOwn[i]]; });
  return sets;
}

} // namespace atria
