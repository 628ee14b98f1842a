// SPDX-License-Identifier: GPL-3.0-or-later
/// Maps identities to consecutive numbers, and compacts lists by such numbers.
#pragma once

#include "Support/Types.h"

#include <bit>
#include <utility>
#include <vector>

namespace atria {

/// Map from identities to numbers: a hash table with linear probing, or a list of all identities if that is no larger.
class Numbering
{
public:
  /// Makes room for `expected` identities.
  explicit Numbering(std::size_t expected) { makeRoom(expected); }
  /// The same, for identities below `end`.
  Numbering(std::size_t expected, std::size_t end)
  {
    if (end * sizeof(Index) <= slotsFor(expected) * sizeof(Slot))
    {
      numbers.resize(end, noIndex);
    }
    else
    {
      makeRoom(expected);
    }
  }

  /// Returns the number of `id`, its place in `list`. An unknown `id` is appended to the list.
  Index findOrAdd(Index id, std::vector<Index>& list)
  {
    if (!numbers.empty())
    {
      if (numbers[id] == noIndex)
      {
        numbers[id] = static_cast<Index>(list.size());
        list.push_back(id);
      }
      return numbers[id];
    }
    if (2 * (list.size() + 1) > slots.size())
    {
      makeRoom(2 * list.size());
    }
    Slot& slot = slotOf(id);
    if (slot.id != id)
    {
      slot = {id, static_cast<Index>(list.size())};
      list.push_back(id);
    }
    return slot.number;
  }
  /// Sets the number of an unknown `id`. There must be room for it.
  void add(Index id, Index number)
  {
    if (numbers.empty())
    {
      slotOf(id) = {id, number};
    }
    else
    {
      numbers[id] = number;
    }
  }
  /// Returns the number of `id`; noIndex if it is unknown.
  Index of(Index id) const { return numbers.empty() ? slotOf(id).number : numbers[id]; }

private:
  struct Slot
  {
    Index id = noIndex;
    Index number = noIndex;
  };

  static std::size_t slotsFor(std::size_t expected) { return std::bit_ceil(2 * expected + 16); }

  const Slot& slotOf(Index id) const
  {
    const std::size_t mask = slots.size() - 1;
    std::size_t at = (id * std::uint64_t{0x9E3779B97F4A7C15} >> 32) & mask;
    while (slots[at].id != id && slots[at].id != noIndex)
    {
      at = (at + 1) & mask;
    }
    return slots[at];
  }
  Slot& slotOf(Index id) { return const_cast<Slot&>(std::as_const(*this).slotOf(id)); }

  void makeRoom(std::size_t expected)
  {
    const std::vector<Slot> before = std::exchange(slots, std::vector<Slot>(slotsFor(expected)));
    for (const Slot& slot : before)
    {
      if (slot.id != noIndex)
      {
        slotOf(slot.id) = slot;
      }
    }
  }

  std::vector<Slot> slots;
  std::vector<Index> numbers; ///< one entry per identity; empty if the hash table is used
};

/// Numbers the entries that stay, in order; the others get noIndex.
inline std::vector<Index> numbersOfKept(const std::vector<char>& stays)
{
  std::vector<Index> numbers(stays.size(), noIndex);
  Index next = 0;
  for (std::size_t i = 0; i < stays.size(); ++i)
  {
    if (stays[i])
    {
      numbers[i] = next++;
    }
  }
  return numbers;
}

/// Moves the entries that stay to their new places and drops the others. `numbers` comes from numbersOfKept and has at
/// least one entry per entry of `list`.
template <typename List> void compact(List& list, const std::vector<Index>& numbers)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < list.size(); ++i)
  {
    if (numbers[i] != noIndex)
    {
      list[numbers[i]] = list[i];
      ++count;
    }
  }
  list.resize(count);
}

} // namespace atria
