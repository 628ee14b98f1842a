// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace atria {

/// For programs, at their start: what the stages of a mesh free stays with the process for the next stage, up to half a
/// gigabyte and but for blocks above 64 MB. Else the system hands out each large array anew, page by page, which is a
/// fifth of the time a mesh takes. Does nothing where the C library is not glibc.
inline void keepFreedMemory()
{
#ifdef M_MMAP_THRESHOLD
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, 512 << 20);
#endif
}

} // namespace atria
