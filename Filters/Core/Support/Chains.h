// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Buffer.h"
#include "Support/Executor.h"
#include "Support/Types.h"

#include <atomic>
#include <cstddef>
#include <utility>

namespace atria {

/// A list of numbers for each of some things, each number linked to the next through an entry of its own. One pass on
/// any threads fills them, where buckets need two and room of their own; a list is in no order.
class Chains
{
public:
  Chains(std::size_t count, const Executor& executor) : isAlone(executor.threads() == 1), heads(count)
  {
    executor.forEach(count, 65536, [&](std::size_t i) { heads[i] = noIndex; });
  }

  /// `next` is the number's entry.
  void add(std::size_t list, Index number, Index& next)
  {
    next = isAlone ? std::exchange(heads[list], number)
                   : std::atomic_ref<Index>(heads[list]).exchange(number, std::memory_order_relaxed);
  }

  /// Of a list, once all are filled; noIndex if it is empty, as is the last one's next.
  Index first(std::size_t list) const { return heads[list]; }

private:
  bool isAlone;
  Buffer<Index> heads;
};

} // namespace atria
