// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Support/Error.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace atria {

/// What is to be written cannot be: the disk is full, a folder must not be written to …
class OutputError : public Error
{
  using Error::Error;
};

/// With those it is in. Throws OutputError naming it where it cannot be made.
void makeFolder(const std::filesystem::path& folder);

/// Removes those files that are there, side by side: the system takes a tenth of a second and more for a gigabyte, and
/// who aborts waits for it. Throws OutputError naming one that cannot be removed.
void removeFiles(const std::vector<std::filesystem::path>& files);

/// Throws OutputError naming the file that cannot be written there.
void moveFiles(const std::filesystem::path& from, const std::filesystem::path& to);

/// Holds files until all are complete, and is removed whatever happens.
class UnfinishedFolder
{
public:
  explicit UnfinishedFolder(std::filesystem::path where);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  /// Throws OutputError naming the file that cannot be written there.
  void moveFilesTo(const std::filesystem::path& folder) const { moveFiles(path, folder); }

  const std::filesystem::path path;
};

/// Takes away what a writer that fails has put where there was nothing: of each folder that is not there yet, the
/// outermost that will have to be made, with all that is in it by then. What was there before stays.
class NewFolders
{
public:
  explicit NewFolders(const std::vector<std::filesystem::path>& folders);
  ~NewFolders();
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;

  /// All is written.
  void keep() { made_.clear(); }

private:
  std::vector<std::filesystem::path> made_;
};

/// Has `write` make a file beside its place, and puts it there once that returns: what was there stays if it throws.
/// Throws Error where the folder does not exist, and OutputError where the file cannot be put in its place.
void writeInPlace(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

} // namespace atria
