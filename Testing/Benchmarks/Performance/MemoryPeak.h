// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdio>
#include <string>

namespace atria::measuring {

/// Peaks of this process's resident memory, from Linux's /proc.
class MemoryPeak
{
public:
  MemoryPeak() { reset(); }

  /// Bytes, the most since this was made or last asked.
  long long sinceLast()
  {
    const long long bytes = read();
    reset();
    return bytes;
  }

private:
  static void reset()
  {
    if (std::FILE* file = std::fopen("/proc/self/clear_refs", "w"))
    {
      std::fputs("5", file); // sets the high-water mark to what is resident now
      std::fclose(file);
    }
  }

  static long long read()
  {
    long long kilobytes = 0;
    if (std::FILE* file = std::fopen("/proc/self/status", "r"))
    {
      char line[256];
      while (std::fgets(line, sizeof line, file) && std::sscanf(line, "VmHWM: %lld", &kilobytes) != 1)
      {
      }
      std::fclose(file);
    }
    return 1024 * kilobytes;
  }
};

} // namespace atria::measuring
