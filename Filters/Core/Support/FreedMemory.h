// SPDX-License-Identifier: GPL-3.0-or-later
/// Returns freed memory to the system.
#pragma once

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace atria {

/// Returns all freed memory to the system, also that between blocks still in use. Call it after a stage that needed
/// much memory if other processes need room. Does nothing if the C library is not glibc.
inline void giveBackFreedMemory()
{
#ifdef M_TRIM_THRESHOLD
  malloc_trim(0);
#endif
}

} // namespace atria
