// SPDX-License-Identifier: GPL-3.0-or-later
/// Vectors whose entries stay uninitialized until they are written, for large arrays.
#pragma once

#include "Support/Memory.h"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace atria {

/// Leaves new entries of a vector uninitialized if they need no constructor. Large arrays are then first written, and
/// get their memory, in the loops that fill them on all threads. Blocks of half a gigabyte and more are requested in
/// large pages: the system takes back a gigabyte of these in 3 ms instead of 40, and a user who aborts waits until
/// gigabytes are freed.
template <typename T> struct UninitializedAllocator : std::allocator<T>
{
  template <typename U> struct rebind
  {
    using other = UninitializedAllocator<U>;
  };
  T* allocate(std::size_t count)
  {
    constexpr std::size_t large = std::size_t{1} << 29;
    T* const start = std::allocator<T>::allocate(count);
    if (count * sizeof(T) >= large)
    {
      useLargePages(start, count * sizeof(T));
    }
    return start;
  }
  template <typename U> void construct(U* place) { ::new (static_cast<void*>(place)) U; }
  template <typename U, typename... Args> void construct(U* place, Args&&... args)
  {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
};

/// Vector whose `resize` leaves new entries unset.
template <typename T> using Buffer = std::vector<T, UninitializedAllocator<T>>;

/// Gives back the memory of a list that is not needed any more, which assigning {} would keep.
template <typename List> void release(List& list) { List().swap(list); }

} // namespace atria
