// SPDX-License-Identifier: GPL-3.0-or-later
/// Union-find over indices.
#pragma once

#include "Support/Types.h"

#include <atomic>
#include <numeric>
#include <utility>
#include <vector>

namespace atria {

/// Disjoint sets of indices. A set's root is its smallest member, so the result does not depend on the order of joins.
class UnionFind
{
public:
  explicit UnionFind(std::size_t count = 0) { reset(count); }

  /// Every index is a set of its own again.
  void reset(std::size_t count)
  {
    parents.resize(count);
    std::iota(parents.begin(), parents.end(), Index{0});
  }

  /// Returns the root of the set of `i`. Any number of threads may call it at once, while none joins.
  Index find(Index i)
  {
    const auto parentOf = [&](Index of) { return std::atomic_ref(parents[of]).load(std::memory_order_relaxed); };
    for (Index up = parentOf(i); up != i;)
    {
      const Index next = parentOf(up);
      std::atomic_ref(parents[i]).store(next, std::memory_order_relaxed);
      i = next;
      up = parentOf(i);
    }
    return i;
  }

  void join(Index a, Index b)
  {
    a = find(a);
    b = find(b);
    if (a > b)
    {
      std::swap(a, b);
    }
    parents[b] = a;
  }

private:
  std::vector<Index> parents;
};

} // namespace atria
