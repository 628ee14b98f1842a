// SPDX-License-Identifier: GPL-3.0-or-later
/// Creates, fills and removes folders so that a failed write leaves no partial files.
#pragma once

#include "Support/Error.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace atria {

/// A file or folder cannot be written, such as on a full disk or in a protected folder.
class OutputError : public Error
{
  using Error::Error;
};

/// Creates the folder and those it is in. Throws OutputError naming the folder if it cannot be created.
void makeFolder(const std::filesystem::path& folder);

/// Removes those of the files that exist, side by side: removing a gigabyte takes the system a tenth of a second and
/// more, and a user who aborts waits for it. Throws OutputError naming a file that cannot be removed.
void removeFiles(const std::vector<std::filesystem::path>& files);

/// Moves all files of a folder to another. Throws OutputError naming a file that cannot be written there.
void moveFiles(const std::filesystem::path& from, const std::filesystem::path& to);

/// Holds files until all are complete. The folder is always removed in the end.
class UnfinishedFolder
{
public:
  explicit UnfinishedFolder(std::filesystem::path where);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  /// Throws OutputError naming a file that cannot be written there.
  void moveFilesTo(const std::filesystem::path& folder) const { moveFiles(path, folder); }

  const std::filesystem::path path;
};

/// Removes the folders that a failed writer has created. For each folder that does not exist yet, removes the outermost
/// one that has to be created, with all its content. Earlier folders and files stay.
class NewFolders
{
public:
  explicit NewFolders(const std::vector<std::filesystem::path>& folders);
  ~NewFolders();
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;

  /// Keeps the folders; called when all is written.
  void keep() { made_.clear(); }

private:
  std::vector<std::filesystem::path> made_;
};

/// Has `write` make a file beside its place, and moves it there when that returns. The earlier file stays if `write`
/// throws. Throws Error if the folder does not exist, and OutputError if the file cannot be moved to its place.
void writeInPlace(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

} // namespace atria
