// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace atria::testing {

/// Asks VTK to run filters on so many threads, also where its backend is Sequential. The backend STDThread takes no
/// more than the machine has.
void useThreads(int count);

/// Another backend of VTK while it lives.
class SmpBackend
{
public:
  explicit SmpBackend(const char* name);
  ~SmpBackend();
  SmpBackend(const SmpBackend&) = delete;
  SmpBackend& operator=(const SmpBackend&) = delete;

private:
  std::string before;
};

} // namespace atria::testing
