// SPDX-License-Identifier: GPL-3.0-or-later
#include "Platform.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#ifdef _WIN32
#include <windows.h>

#include <io.h>
#include <process.h>
#include <psapi.h>
#else
#include <sys/resource.h>
#include <unistd.h>
#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif
#endif

namespace atria::tool {

#ifdef _WIN32

bool errorsGoToTerminal() { return _isatty(_fileno(stderr)) != 0; }

std::optional<double> largestFile() { return {}; }

long long peakMemoryBytes()
{
  PROCESS_MEMORY_COUNTERS counters{};
  return GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof(counters))
             ? static_cast<long long>(counters.PeakWorkingSetSize)
             : 0;
}

std::string programFile()
{
  std::array<char, MAX_PATH> path{};
  const DWORD length = GetModuleFileNameA(nullptr, path.data(), MAX_PATH);
  return length < MAX_PATH ? std::string(path.data(), length) : std::string();
}

#else

bool errorsGoToTerminal() { return isatty(STDERR_FILENO) != 0; }

std::optional<double> largestFile()
{
  rlimit most{};
  const bool isLimited = getrlimit(RLIMIT_FSIZE, &most) == 0 && most.rlim_cur != RLIM_INFINITY;
  return isLimited ? std::optional(static_cast<double>(most.rlim_cur)) : std::nullopt;
}

long long peakMemoryBytes()
{
#ifdef __APPLE__
  constexpr long long unit = 1;
#else
  constexpr long long unit = 1024;
#endif
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return unit * usage.ru_maxrss;
}

std::string programFile()
{
#ifdef __APPLE__
  std::array<char, 4096> path{};
  auto size = static_cast<std::uint32_t>(path.size());
  return _NSGetExecutablePath(path.data(), &size) == 0 ? vtksys::SystemTools::GetRealPath(path.data()) : std::string();
#else
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).string();
#endif
}

#endif

void prependPath(const std::string& variable, const std::string& folder)
{
#ifdef _WIN32
  const char* const separator = ";";
#else
  const char* const separator = ":";
#endif
  const char* const others = std::getenv(variable.c_str());
  vtksys::SystemTools::PutEnv(variable + "=" + folder + (others && *others ? std::string(separator) + others : ""));
}

std::string becomeProgram(std::vector<std::string> command)
{
  std::vector<char*> words(command.size() + 1, nullptr);
  std::ranges::transform(command, words.begin(), [](std::string& word) { return word.data(); });
#ifdef _WIN32
  // On Windows, exec would end this program at once, and the shell would continue beside the other.
  const std::intptr_t status = _spawnvp(_P_WAIT, words[0], words.data());
  if (status >= 0)
  {
    std::exit(static_cast<int>(status));
  }
#else
  execvp(words[0], words.data());
#endif
  return std::strerror(errno);
}

} // namespace atria::tool
