// SPDX-License-Identifier: GPL-3.0-or-later
#include "Support/MachineMemory.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

#if __has_include(<sys/resource.h>) && __has_include(<unistd.h>)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace atria {

namespace fs = std::filesystem;

namespace {

/// Returns the number in a file of a control group; unlimitedMemory if it holds no number but a word such as "max".
std::size_t limitIn(const fs::path& file)
{
  std::ifstream in(file);
  std::size_t bytes = 0;
  return in >> bytes && bytes > 0 ? bytes : unlimitedMemory;
}

/// Returns the smallest limit of a group and of the groups around it. In a container, the group's path may be the one
/// outside the container; the limit at the top of the hierarchy is then its own.
std::size_t limitOf(const fs::path& hierarchy, const std::string& group, const char* file)
{
  std::size_t limit = limitIn(hierarchy / file);
  fs::path at = hierarchy;
  for (const fs::path& part : fs::path(group).relative_path())
  {
    at /= part;
    limit = std::min(limit, limitIn(at / file));
  }
  return limit;
}

#if __has_include(<sys/resource.h>) && __has_include(<unistd.h>)
/// The type of `resource` differs between C libraries.
template <typename Resource> std::size_t resourceLimit(Resource resource)
{
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? static_cast<std::size_t>(limit.rlim_cur)
                                                                             : unlimitedMemory;
}

std::size_t physicalMemory()
{
  const long pages = sysconf(_SC_PHYS_PAGES);
  const long size = sysconf(_SC_PAGE_SIZE);
  return pages > 0 && size > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(size) : unlimitedMemory;
}
#endif

} // namespace

std::size_t controlGroupLimit(const fs::path& root, const std::string& membership)
{
  std::size_t limit = unlimitedMemory;
  std::istringstream lines(membership);
  for (std::string line; std::getline(lines, line);)
  {
    // hierarchy:controllers:group; version 2 has the hierarchy 0 and no controllers.
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos)
    {
      continue;
    }
    const std::string group = line.substr(second + 1);
    if (second == first + 1)
    {
      limit = std::min(limit, limitOf(root, group, "memory.max"));
    }
    std::istringstream controllers(line.substr(first + 1, second - first - 1));
    for (std::string controller; std::getline(controllers, controller, ',');)
    {
      limit =
          controller != "memory" ? limit : std::min(limit, limitOf(root / controller, group, "memory.limit_in_bytes"));
    }
  }
  return limit;
}

std::size_t memoryOfMachine()
{
  std::ifstream in("/proc/self/cgroup");
  const std::string membership(std::istreambuf_iterator<char>(in), {});
  std::size_t least = controlGroupLimit("/sys/fs/cgroup", membership);
#if __has_include(<sys/resource.h>) && __has_include(<unistd.h>)
  least = std::min({least, physicalMemory(), resourceLimit(RLIMIT_AS), resourceLimit(RLIMIT_DATA)});
#endif
  return least;
}

} // namespace atria
