// SPDX-License-Identifier: GPL-3.0-or-later
/// Requests large pages for large arrays, and controls when freed memory returns to the system.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory_resource>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif
#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace atria {

/// Keeps memory that stages free with the process, except for blocks above a gigabyte. Programs call it at their start.
/// Otherwise the system hands out each large array anew, page by page, which takes a fifth of the time of a mesh. Does
/// nothing if the C library is not glibc.
inline void keepFreedMemory()
{
#ifdef M_MMAP_THRESHOLD
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

#if __has_include(<sys/mman.h>)
/// Advises the system about the large pages that lie within a block. Returns how many bytes they reach from `start`. A
/// refusal is ignored.
inline std::size_t advise(void* start, std::size_t bytes, int advice)
{
  constexpr std::uintptr_t page = std::uintptr_t{1} << 21;
  const auto first = reinterpret_cast<std::uintptr_t>(start);
  const auto begin = (first + page - 1) & ~(page - 1);
  const auto end = (first + bytes) & ~(page - 1);
  if (begin >= end)
  {
    return 0;
  }
  static_cast<void>(madvise(static_cast<char*>(start) + (begin - first), end - begin, advice));
  return end - first;
}
#endif

/// Allows the system to hand out memory in pages of two megabytes; call it before the memory is first written. Small
/// pages take up to a third of the time it takes to read a large file. Does nothing for small blocks, or if the system
/// has no such pages.
inline void useLargePages([[maybe_unused]] void* start, [[maybe_unused]] std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  advise(start, bytes, MADV_HUGEPAGE);
#endif
}

/// Returns memory to the system before it is freed; its contents are lost. Only whole pages of two megabytes are
/// returned. Returns the number of bytes from `start` that are done.
inline std::size_t forgetPages([[maybe_unused]] void* start, [[maybe_unused]] std::size_t bytes)
{
#ifdef MADV_DONTNEED
  return advise(start, bytes, MADV_DONTNEED);
#else
  return bytes;
#endif
}

/// Reserves room in a vector, in large pages.
template <class Vector> void reserveLarge(Vector& vector, std::size_t count)
{
  vector.reserve(count);
  useLargePages(vector.data(), vector.capacity() * sizeof(typename Vector::value_type));
}

/// Memory in large pages, for resources that request large blocks.
class LargePages : public std::pmr::memory_resource
{
private:
  void* do_allocate(std::size_t bytes, std::size_t alignment) override
  {
    void* const start = std::pmr::new_delete_resource()->allocate(bytes, alignment);
    useLargePages(start, bytes);
    return start;
  }
  void do_deallocate(void* start, std::size_t bytes, std::size_t alignment) override
  {
    std::pmr::new_delete_resource()->deallocate(start, bytes, alignment);
  }
  bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

} // namespace atria
