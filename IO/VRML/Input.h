// SPDX-License-Identifier: GPL-3.0-or-later
/// Files as they are found in the wild: compressed or not, beside each other under names of another case.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace atria::vrml {

/// The text of a file, unpacked where its first bytes say gzip, without a UTF-8 byte order mark.
struct FileText
{
  std::string text;
  bool truncated = false; ///< the compressed stream ends early or is damaged; `text` holds what could be unpacked
};

/// Throws Error where the file cannot be read or is encoded in UTF-16.
FileText readText(const std::filesystem::path& file);

/// The first few hundred characters of the text; empty where the file cannot be read.
std::string readStart(const std::filesystem::path& file);

/// The file a URL in a model of `folder` means; nothing for network addresses and files that are not there.
/// Accepts backslashes, file: URLs, %20 and the like, a trailing #Name, and names that differ in case; a file
/// that is not where the URL says is also looked for in `folder` itself, since exporters write paths of the
/// machine they ran on.
std::optional<std::filesystem::path> findFile(const std::filesystem::path& folder, const std::string& url);

/// `text` as UTF-8: unchanged where it is, else read as Latin-1.
std::string toUtf8(std::string_view text);

} // namespace atria::vrml
