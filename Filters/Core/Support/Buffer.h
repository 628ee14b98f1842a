// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace atria {

/// Leaves entries of a vector that grows as they are, where they need no constructor: large arrays then are first
/// written, and given their memory, by the loops that fill them on all threads.
template <typename T> struct UninitialisedAllocator : std::allocator<T>
{
  template <typename U> struct rebind
  {
    using other = UninitialisedAllocator<U>;
  };
  template <typename U> void construct(U* place) { ::new (static_cast<void*>(place)) U; }
  template <typename U, typename... Args> void construct(U* place, Args&&... args)
  {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
};

/// A vector whose entries are not set by `resize`.
template <typename T> using Buffer = std::vector<T, UninitialisedAllocator<T>>;

} // namespace atria
