// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Types.h"

#include <bit>
#include <vector>

namespace atria {

/// Spreads the bits of a number over all of it (the finaliser of splitmix64).
inline std::uint64_t mixed(std::uint64_t x)
{
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// A hash table of indices into something else, with linear probing: four bytes an entry at half load.
class IndexTable
{
public:
  explicit IndexTable(std::size_t expected) : slots(std::bit_ceil(2 * expected + 2), noIndex) {}

  /// The index added first of those for which `isSame` says true, or `index`, which is then added. The hash of equal
  /// things must be equal. At most as many may be added as were expected.
  template <class IsSame> Index findOrAdd(std::uint64_t hash, Index index, IsSame&& isSame)
  {
    const std::size_t mask = slots.size() - 1;
    for (std::size_t at = hash & mask;; at = (at + 1) & mask)
    {
      Index& slot = slots[at];
      if (slot == noIndex)
      {
        slot = index;
        return index;
      }
      if (isSame(slot))
      {
        return slot;
      }
    }
  }

private:
  std::vector<Index> slots;
};

} // namespace atria
