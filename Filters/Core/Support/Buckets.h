// SPDX-License-Identifier: GPL-3.0-or-later
/// Lists of numbers, one list per bucket, in two flat arrays.
#pragma once

#include "Support/Buffer.h"
#include "Support/Executor.h"
#include "Support/Types.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <span>

namespace atria {

/// One list of numbers per bucket; the lists are stored one behind the other.
struct Buckets
{
  Buffer<Index> offsets;
  Buffer<Index> entries;

  std::span<const Index> of(std::size_t bucket) const
  {
    return {entries.data() + offsets[bucket], entries.data() + offsets[bucket + 1]};
  }
};

/// Fills `count` buckets. `forPairs(use)` calls use(bucket, entry) for all entries, on any threads of the executor; it
/// runs twice and must give the same pairs. Entries of a bucket are in the order of the calls on one thread, and
/// unordered on several. O(count + entries).
template <typename ForPairs> Buckets fillBuckets(std::size_t count, const Executor& executor, ForPairs&& forPairs)
{
  const bool isAlone = executor.threads() == 1;
  const auto increment = [isAlone](Index& value) {
    return isAlone ? value++ : std::atomic_ref<Index>(value).fetch_add(1, std::memory_order_relaxed);
  };
  // Counted two places up and summed one place up, an offset serves as its bucket's cursor, and ends as its begin.
  Buckets out;
  out.offsets.resize(count + 2);
  executor.forEach(out.offsets.size(), 65536, [&](std::size_t i) { out.offsets[i] = 0; });
  forPairs([&](Index bucket, Index) { increment(out.offsets[bucket + 2]); });
  std::partial_sum(out.offsets.begin(), out.offsets.end(), out.offsets.begin());
  out.entries.resize(out.offsets.back());
  forPairs([&](Index bucket, Index entry) { out.entries[increment(out.offsets[bucket + 1])] = entry; });
  out.offsets.pop_back();
  return out;
}

/// Fills buckets whose entries are in rising order. On one thread, `forPairs` must give the entries of a bucket in that
/// order.
template <typename ForPairs> Buckets fillInOrder(std::size_t count, const Executor& executor, ForPairs&& forPairs)
{
  Buckets out = fillBuckets(count, executor, forPairs);
  if (executor.threads() > 1)
  {
    executor.forEach(count, 4096, [&](std::size_t bucket) {
      std::sort(out.entries.begin() + out.offsets[bucket], out.entries.begin() + out.offsets[bucket + 1]);
    });
  }
  return out;
}

} // namespace atria
