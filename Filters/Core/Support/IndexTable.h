// SPDX-License-Identifier: GPL-3.0-or-later
/// Hash table that finds the index of an equal thing.
#pragma once

#include "Support/Memory.h"
#include "Support/Types.h"

#include <bit>
#include <vector>

namespace atria {

/// Spreads the bits of a number over all 64 bits (the finalizer of splitmix64).
inline std::uint64_t mixed(std::uint64_t x)
{
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/// Hash table of indices into another list, with linear probing. Entries keep a part of their hash, so that unequal
/// things are hardly ever compared.
class IndexTable
{
public:
  explicit IndexTable(std::size_t expected)
  {
    const std::size_t size = std::bit_ceil(2 * expected + 2);
    reserveLarge(slots, size);
    slots.resize(size);
  }

  /// Returns the first index added for which `isSame` is true. If there is none, adds `index` and returns it. Equal
  /// things must have equal hashes. At most `expected` indices may be added.
  template <class IsSame> Index findOrAdd(std::uint64_t hash, Index index, IsSame&& isSame)
  {
    const std::size_t mask = slots.size() - 1;
    const auto tag = static_cast<std::uint32_t>(hash >> 32);
    for (std::size_t at = hash & mask;; at = (at + 1) & mask)
    {
      Slot& slot = slots[at];
      if (slot.index == noIndex)
      {
        slot = {index, tag};
        return index;
      }
      if (slot.tag == tag && isSame(slot.index))
      {
        return slot.index;
      }
    }
  }

private:
  struct Slot
  {
    Index index = noIndex;
    std::uint32_t tag = 0;
  };
  std::vector<Slot> slots;
};

} // namespace atria
