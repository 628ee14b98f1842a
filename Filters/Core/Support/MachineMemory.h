// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>

namespace atria {

inline constexpr std::size_t unlimitedMemory = std::numeric_limits<std::size_t>::max();

/// Bytes of memory this process may use at most: the machine's, or less where its container or its shell (ulimit)
/// allows less. unlimitedMemory where the system does not say.
std::size_t memoryOfMachine();

/// The least limit of a process' control groups, by which containers are limited, and of the groups around them.
/// `membership` is the text of /proc/self/cgroup, `root` where the groups' files are. unlimitedMemory without any.
std::size_t controlGroupLimit(const std::filesystem::path& root, const std::string& membership);

} // namespace atria
