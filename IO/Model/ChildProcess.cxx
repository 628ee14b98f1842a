// SPDX-License-Identifier: GPL-3.0-or-later
#include "ChildProcess.h"

#include "Support/Error.h"
#include "Support/Progress.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace atria::model {

namespace {

/// A running program, which is ended with this object.
class Child
{
public:
  explicit Child(const std::vector<std::string>& command)
  {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
    {
      throw Error("no pipe can be made for " + command.front() + ": " + std::strerror(errno));
    }
    output = ends[0];
    std::vector<char*> words;
    for (const std::string& word : command)
    {
      words.push_back(const_cast<char*>(word.c_str()));
    }
    words.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    const int failure = posix_spawn(&process, words[0], &actions, nullptr, words.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (failure != 0)
    {
      close(output);
      throw Error(command.front() + " cannot be started: " + std::strerror(failure));
    }
  }

  ~Child()
  {
    close(output);
    if (process > 0)
    {
      kill(process, SIGKILL);
      wait();
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Appends what has been written within a tenth of a second; false at the end.
  bool read(std::string& to) const
  {
    constexpr int milliseconds = 100;
    pollfd watched{output, POLLIN, 0};
    if (poll(&watched, 1, milliseconds) <= 0)
    {
      return true;
    }
    std::array<char, 1 << 16> bytes;
    const ssize_t count = ::read(output, bytes.data(), bytes.size());
    to.append(bytes.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
    return count > 0 || (count < 0 && errno == EINTR);
  }

  int wait()
  {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
    {
    }
    process = 0;
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  }

private:
  int output = -1;
  pid_t process = 0;
};

} // namespace

ChildResult runChild(const std::vector<std::string>& command, const ProgressRange& progress)
{
  Child child(command);
  ChildResult result;
  while (child.read(result.output))
  {
    progress.check();
  }
  result.status = child.wait();
  return result;
}

std::string ownProgram(const std::string& name)
{
  namespace fs = std::filesystem;
  Dl_info library{};
  if (dladdr(reinterpret_cast<const void*>(&ownProgram), &library) == 0 || !library.dli_fname)
  {
    return {};
  }
  std::error_code none;
  for (fs::path folder = fs::canonical(library.dli_fname, none).parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
  {
    const fs::path program = folder / "libexec" / "atria" / name;
    if (fs::exists(program, none))
    {
      return program.string();
    }
  }
  return {};
}

} // namespace atria::model
