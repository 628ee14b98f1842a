// SPDX-License-Identifier: GPL-3.0-or-later
#include "Files.h"

#include "Console.h"

#include <vtkAlgorithm.h>

#include <filesystem>
#include <fstream>
#include <vector>

namespace atria::tool {

namespace fs = std::filesystem;

bool isInPieces(const std::string& file) { return fs::path(file).extension() == ".pvtu"; }

void checkReadable(const std::string& file)
{
  if (fs::is_directory(file))
  {
    throw Failure(BadInput, file + " is a folder; name a file");
  }
  if (!fs::exists(file))
  {
    throw Failure(BadInput, file + " does not exist; check the path");
  }
  if (!std::ifstream(file).good())
  {
    throw Failure(BadInput, file + " cannot be opened; check its permissions");
  }
}

void checkOutput(const std::string& option, const std::string& file, const std::string& ending)
{
  const fs::path path(file);
  if (path.extension() != ending)
  {
    throw Failure(Usage, option + " " + file + ": the file's name must end in " + ending);
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
  {
    throw Failure(Usage, option + " " + file + ": the folder " + folder.string() + " does not exist; make it first");
  }
}

void checkFolder(const std::string& option, const std::string& folder)
{
  fs::path path = fs::path(folder).lexically_normal();
  path = path.has_filename() ? path : path.parent_path(); // without the last slash
  const fs::path parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (fs::exists(path) && !fs::is_directory(path))
  {
    throw Failure(Usage, option + " " + folder + " is a file; name a folder");
  }
  if (!fs::is_directory(parent))
  {
    throw Failure(Usage, option + " " + folder + ": the folder " + parent.string() + " does not exist; make it first");
  }
}

void throwIfErrors(Console& console, ExitStatus status, const std::string& about)
{
  Console::throwIfInterrupted();
  const std::vector<std::string> errors = console.takeErrors();
  if (errors.empty())
  {
    return;
  }
  // An error that already names its file gets no prefix.
  std::string text = errors.front().find(about) == std::string::npos ? about + ": " : "";
  for (std::size_t i = 0; i < errors.size(); ++i)
  {
    text += (i == 0 ? "" : "\n") + errors[i];
  }
  throw Failure(status, text);
}

void updateOrFail(vtkAlgorithm* algorithm, const std::string& about, Console& console)
{
  algorithm->Update();
  throwIfErrors(console, BadInput, about);
}

} // namespace atria::tool
