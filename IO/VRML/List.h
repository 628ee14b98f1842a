// SPDX-License-Identifier: GPL-3.0-or-later
/// A compact list in memory that is freed all at once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <type_traits>

namespace atria::vrml {

/// A list of trivially copyable items. Files have millions of them, most with one or two items. It is half as large as
/// a vector, and a copy refers to the same items.
template <class T> class List
{
  static_assert(std::is_trivially_copyable_v<T>);

public:
  List() = default;
  List(std::span<const T> items, std::pmr::memory_resource& memory)
  {
    reserve(items.size(), memory);
    std::uninitialized_copy(items.begin(), items.end(), first);
    count = static_cast<std::uint32_t>(items.size());
  }

  void reserve(std::size_t wanted, std::pmr::memory_resource& memory)
  {
    if (wanted > room)
    {
      T* const larger = static_cast<T*>(memory.allocate(wanted * sizeof(T), alignof(T)));
      std::uninitialized_copy(begin(), end(), larger);
      first = larger;
      room = static_cast<std::uint32_t>(wanted);
    }
  }
  void push_back(const T& item, std::pmr::memory_resource& memory)
  {
    if (count == room)
    {
      reserve(std::max<std::size_t>(1, 2 * std::size_t{room}), memory);
    }
    std::construct_at(first + count, item);
    ++count;
  }
  /// Keeps the first items only.
  void truncate(std::size_t items) { count = static_cast<std::uint32_t>(items); }

  T* begin() { return first; }
  T* end() { return first + count; }
  const T* begin() const { return first; }
  const T* end() const { return first + count; }
  const T* data() const { return first; }
  T& operator[](std::size_t i) { return first[i]; }
  const T& operator[](std::size_t i) const { return first[i]; }
  const T& front() const { return *first; }
  const T& back() const { return first[count - 1]; }
  std::size_t size() const { return count; }
  bool empty() const { return count == 0; }

private:
  T* first = nullptr;
  std::uint32_t count = 0; ///< 2^32 numbers are more than any model has
  std::uint32_t room = 0;
};

} // namespace atria::vrml
