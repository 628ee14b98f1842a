// SPDX-License-Identifier: GPL-3.0-or-later
/// Files as they are found in the wild: compressed or not, beside each other under names of another case.
#pragma once

#include "Support/Utf8.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace atria::vrml {

struct FileText
{
  std::unique_ptr<char[]> bytes; ///< of the file; not a string, which would be filled with zeros first
  std::size_t size = 0;
  std::string unpacked;
  bool isPacked = false;
  std::size_t start = 0;     ///< after a UTF-8 byte order mark
  std::size_t forgotten = 0; ///< bytes
  bool truncated = false;    ///< the compressed stream ends early or is damaged; `unpacked` is what there was

  /// Gives back the memory of the first so many characters, which nobody looks at again.
  void forget(std::size_t characters);

  /// The text of the file, unpacked where its first bytes say gzip, without a byte order mark.
  std::string_view text() const
  {
    return (isPacked ? std::string_view(unpacked) : std::string_view(bytes.get(), size)).substr(start);
  }
};

/// Throws Error where the file cannot be read or is encoded in UTF-16.
FileText readText(const std::filesystem::path& file);

/// The first few hundred characters of the text; empty where the file cannot be read.
std::string readStart(const std::filesystem::path& file);

/// The file a URL in a model of `folder` means; nothing for network addresses and files that are not there.
/// Accepts backslashes, file: URLs, %20 and the like, a trailing #Name, and names that differ in case.
std::optional<std::filesystem::path> findFile(const std::filesystem::path& folder, std::string_view url);

/// A file of the same name in `folder` itself, since exporters write paths of the machine they ran on.
std::optional<std::filesystem::path> findNamesake(const std::filesystem::path& folder, std::string_view url);

} // namespace atria::vrml
