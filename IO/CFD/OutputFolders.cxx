// SPDX-License-Identifier: GPL-3.0-or-later
#include "OutputFolders.h"

#include <future>
#include <system_error>
#include <utility>

namespace atria {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> filesIn(const fs::path& folder)
{
  std::vector<fs::path> files;
  for (const fs::directory_entry& file : fs::directory_iterator(folder))
  {
    files.push_back(file.path());
  }
  return files;
}

} // namespace

void makeFolder(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
  {
    throw OutputError("cannot make the folder '" + folder.string() + "': " + error.message());
  }
}

void removeFiles(const std::vector<fs::path>& files)
{
  std::vector<std::future<void>> removals;
  for (const fs::path& file : files)
  {
    std::error_code error;
    if (fs::symlink_status(file, error).type() == fs::file_type::not_found)
    {
      continue;
    }
    removals.push_back(std::async([&file] {
      std::error_code problem;
      fs::remove(file, problem);
      if (problem)
      {
        throw OutputError("cannot remove '" + file.string() + "': " + problem.message());
      }
    }));
  }
  for (std::future<void>& removal : removals)
  {
    removal.get();
  }
}

void moveFiles(const fs::path& from, const fs::path& to)
{
  for (const fs::path& file : filesIn(from))
  {
    std::error_code error;
    fs::rename(file, to / file.filename(), error);
    if (error)
    {
      throw OutputError("cannot write '" + (to / file.filename()).string() + "': " + error.message());
    }
  }
}

UnfinishedFolder::UnfinishedFolder(fs::path where) : path(std::move(where))
{
  std::error_code ignored;
  fs::remove_all(path, ignored); // left by a process that was killed
  makeFolder(path);
}

UnfinishedFolder::~UnfinishedFolder()
{
  try
  {
    removeFiles(filesIn(path));
  }
  catch (const std::exception&)
  {
    // The rest is removed below, or stays.
  }
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

NewFolders::NewFolders(const std::vector<fs::path>& folders)
{
  for (const fs::path& folder : folders)
  {
    fs::path outermost;
    std::error_code ignored;
    for (fs::path at = fs::absolute(folder).lexically_normal();
         fs::symlink_status(at, ignored).type() == fs::file_type::not_found; at = at.parent_path())
    {
      outermost = at;
    }
    if (!outermost.empty())
    {
      made_.push_back(outermost);
    }
  }
}

NewFolders::~NewFolders()
{
  for (const fs::path& folder : made_)
  {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
  }
}

void writeInPlace(const fs::path& file, const std::function<void(const fs::path&)>& write)
{
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder))
  {
    throw Error("the folder '" + folder.string() + "' does not exist; make it first");
  }
  if (fs::is_directory(file))
  {
    throw Error("'" + file.string() + "' is a folder; name a file");
  }
  const UnfinishedFolder unfinished(folder / ('.' + file.filename().string() + ".unfinished"));
  write(unfinished.path / file.filename());
  unfinished.moveFilesTo(folder);
}

} // namespace atria
