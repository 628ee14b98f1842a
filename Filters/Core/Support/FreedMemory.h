// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace atria {

/// Gives back to the system all that was freed, also between what is still used: after a stage that needed much, where
/// there is to be room for other processes. Does nothing where the C library is not glibc.
inline void giveBackFreedMemory()
{
#ifdef M_TRIM_THRESHOLD
  malloc_trim(0);
#endif
}

} // namespace atria
