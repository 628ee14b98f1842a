// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace atria {

/// For programs, at their start: what the stages of a mesh free stays with the process for the next stage, but for
/// blocks above a gigabyte. Else the system hands out each large array anew, page by page, which is a fifth of the time
/// a mesh takes. Does nothing where the C library is not glibc.
inline void keepFreedMemory()
{
#ifdef M_MMAP_THRESHOLD
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
#endif
}

} // namespace atria
