// SPDX-License-Identifier: GPL-3.0-or-later
#include "ChildProcess.h"

#include "Support/Error.h"
#include "Support/Progress.h"

#include <vtksys/Process.h>

#include <filesystem>
#include <memory>

#ifdef _WIN32
#include <vtkResourceFileLocator.h>
#else
#include <dlfcn.h>
#endif

namespace atria::model {

namespace {

struct EndProcess
{
  void operator()(vtksysProcess* process) const
  {
    vtksysProcess_Kill(process);
    vtksysProcess_WaitForExit(process, nullptr);
    vtksysProcess_Delete(process);
  }
};

/// Returns the path of the library; empty if the system does not report it.
std::string ownLibrary()
{
#ifdef _WIN32
  return vtkResourceFileLocator::GetLibraryPathForSymbolWin32(reinterpret_cast<const void*>(&ownProgram));
#else
  Dl_info library{};
  const int found = dladdr(reinterpret_cast<const void*>(&ownProgram), &library);
  return found != 0 && library.dli_fname ? library.dli_fname : std::string();
#endif
}

} // namespace

ChildResult runChild(const std::vector<std::string>& command, const ProgressRange& progress)
{
  std::vector<const char*> words;
  words.reserve(command.size() + 1);
  for (const std::string& word : command)
  {
    words.push_back(word.c_str());
  }
  words.push_back(nullptr);
  const std::unique_ptr<vtksysProcess, EndProcess> process(vtksysProcess_New());
  vtksysProcess_SetCommand(process.get(), words.data());
  vtksysProcess_SetOption(process.get(), vtksysProcess_Option_HideWindow, 1);
  vtksysProcess_Execute(process.get());
  ChildResult result;
  for (int pipe = vtksysProcess_Pipe_Timeout; pipe != vtksysProcess_Pipe_None;)
  {
    char* bytes = nullptr;
    int count = 0;
    double seconds = 0.1;
    pipe = vtksysProcess_WaitForData(process.get(), &bytes, &count, &seconds);
    if (pipe == vtksysProcess_Pipe_STDOUT)
    {
      result.output.append(bytes, static_cast<std::size_t>(count));
    }
    progress.check();
  }
  vtksysProcess_WaitForExit(process.get(), nullptr);
  const int state = vtksysProcess_GetState(process.get());
  if (state == vtksysProcess_State_Error)
  {
    throw Error(command.front() + " cannot be started: " + vtksysProcess_GetErrorString(process.get()));
  }
  result.status =
      state == vtksysProcess_State_Exited ? vtksysProcess_GetExitValue(process.get()) : ChildResult::crashed;
  return result;
}

std::string ownProgram(const std::string& name)
{
  namespace fs = std::filesystem;
#ifdef _WIN32
  const std::string file = name + ".exe";
#else
  const std::string& file = name;
#endif
  std::error_code none;
  for (fs::path folder = fs::canonical(ownLibrary(), none).parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
  {
    const fs::path program = folder / "libexec" / "atria" / file;
    if (fs::exists(program, none))
    {
      return program.string();
    }
  }
  return {};
}

} // namespace atria::model
