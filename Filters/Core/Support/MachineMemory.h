// SPDX-License-Identifier: GPL-3.0-or-later
/// Limit of the memory that this process may use.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>

namespace atria {

inline constexpr std::size_t unlimitedMemory = std::numeric_limits<std::size_t>::max();

/// Returns the most memory this process may use, in bytes: the machine's, or less if its container or shell (ulimit)
/// allows less. Returns unlimitedMemory if the system does not say.
std::size_t memoryOfMachine();

/// Returns the smallest memory limit of a process's control groups and of the groups around them, in bytes. Containers
/// are limited by control groups. `membership` is the text of /proc/self/cgroup, `root` the folder of the groups'
/// files. Returns unlimitedMemory if there is no limit.
std::size_t controlGroupLimit(const std::filesystem::path& root, const std::string& membership);

} // namespace atria
