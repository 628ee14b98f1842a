// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace atria::testing {

/// Models of ours: Testing/Data.
std::filesystem::path dataFolder();

/// Models others wrote: ATRIA_CORPUS, or ../shared/corpus beside the repository; nothing where it is absent.
std::optional<std::filesystem::path> corpusFolder();

/// All that a file holds.
std::string bytesOf(const std::filesystem::path& file);

/// A fresh folder, removed with the object.
class ScratchFolder
{
public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace atria::testing
