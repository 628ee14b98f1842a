// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

namespace atria {

/// With those it is in. Throws Error naming it where it cannot be made.
void makeFolder(const std::filesystem::path& folder);

/// Removes those files that are there, side by side: the system takes a tenth of a second and more for a gigabyte, and
/// who aborts waits for it. Throws Error naming one that cannot be removed.
void removeFiles(const std::vector<std::filesystem::path>& files);

/// Throws Error naming the file that cannot be written there.
void moveFiles(const std::filesystem::path& from, const std::filesystem::path& to);

/// Holds files until all are complete, and is removed whatever happens.
class UnfinishedFolder
{
public:
  explicit UnfinishedFolder(std::filesystem::path where);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  void moveFilesTo(const std::filesystem::path& folder) const { moveFiles(path, folder); }

  const std::filesystem::path path;
};

/// Has `write` make a file beside its place, and puts it there once that returns: what was there stays if it throws.
/// Throws Error where the folder does not exist and where the file cannot be put in its place.
void writeInPlace(const std::filesystem::path& file, const std::function<void(const std::filesystem::path&)>& write);

} // namespace atria
