// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads files, compressed or not, and finds files whose URLs or names in a model are inexact.
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
  std::unique_ptr<char[]> bytes; ///< bytes of the file; not a string, which would be filled with zeros first
  std::size_t size = 0;
  std::string unpacked;
  bool isPacked = false;
  std::size_t start = 0;     ///< after a UTF-8 byte order mark
  std::size_t forgotten = 0; ///< bytes given back to the system
  bool truncated = false;    ///< the compressed stream ends early or is damaged; `unpacked` is the part before that

  /// Frees the memory of the first so many characters, which are not read again.
  void forget(std::size_t characters);

  /// Returns the text of the file without a byte order mark, unpacked if its first bytes say gzip.
  std::string_view text() const
  {
    return (isPacked ? std::string_view(unpacked) : std::string_view(bytes.get(), size)).substr(start);
  }
};

/// Reads a file. Throws Error if it cannot be read or is encoded in UTF-16.
FileText readText(const std::filesystem::path& file);

/// Returns the first few hundred characters of the text; empty if the file cannot be read.
std::string readStart(const std::filesystem::path& file);

/// Returns the file that a URL in a model of `folder` means; nothing for network addresses and missing files. Accepts
/// backslashes, file: URLs, %20 and the like, a trailing #Name, and names that differ in case.
std::optional<std::filesystem::path> findFile(const std::filesystem::path& folder, std::string_view url);

/// Returns a file of the same name in `folder` itself, since exporters write paths of the machine they ran on.
std::optional<std::filesystem::path> findNamesake(const std::filesystem::path& folder, std::string_view url);

} // namespace atria::vrml
