// SPDX-License-Identifier: GPL-3.0-or-later
/// Sorts lists on all threads, and keeps sorted lists unique.
#pragma once

#include "Support/RunContext.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace atria {

/// Sorts on all threads, in pieces that are then merged. Entries that compare equal end in any order; results that must
/// be the same for any number of threads must not depend on it.
template <typename T, typename Less> void sortOnThreads(std::vector<T>& list, const RunContext& context, Less less)
{
  constexpr std::size_t leastPiece = 16384;
  std::size_t length = list.size();
  for (int halvings = 0; halvings < 6 && context.executor.threads() >> halvings > 0 && length > leastPiece; ++halvings)
  {
    length = (length + 1) / 2;
  }
  const auto at = [&](std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(std::min(i, list.size())); };
  const std::size_t pieces = length == 0 ? 0 : (list.size() + length - 1) / length;
  context.executor.forEach(pieces, 1, [&](std::size_t i) { std::sort(at(i * length), at((i + 1) * length), less); });
  context.progress.check();
  for (; length < list.size(); length *= 2)
  {
    context.executor.forEach((list.size() + 2 * length - 1) / (2 * length), 1, [&](std::size_t i) {
      std::inplace_merge(at(2 * i * length), at((2 * i + 1) * length), at((2 * i + 2) * length), less);
    });
    context.progress.check();
  }
}

template <typename T> void sortOnThreads(std::vector<T>& list, const RunContext& context)
{
  sortOnThreads(list, context, std::less<>());
}

/// Sorts a list in rising order and removes duplicates.
template <typename T> void sortUnique(std::vector<T>& list)
{
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Adds the entries of one sorted unique list to another.
template <typename T> void mergeUnique(std::vector<T>& list, const std::vector<T>& more)
{
  std::vector<T> all;
  all.reserve(list.size() + more.size());
  std::set_union(list.begin(), list.end(), more.begin(), more.end(), std::back_inserter(all));
  list = std::move(all);
}

} // namespace atria
