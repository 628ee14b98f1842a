// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Diagnostics.h"
#include "SceneGraph.h"

#include "Support/Progress.h"

#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace atria::vrml {

/// The version a file's first line declares.
Version versionOf(std::string_view text);

/// Opens files and keeps them: a file inlined many times is read once.
class Library
{
public:
  Library(Diagnostics& messages, const ProgressRange& monitor) : diagnostics(messages), progress(monitor) {}

  /// Throws Error where the file cannot be read or is not VRML, Aborted where the caller stops it.
  const Document& open(const std::filesystem::path& file);

  /// The first of `urls` that can be read, relative to the document that mentions them. Where none can, a file of the
  /// same name beside that document, with a warning; else null, with another. `user` is the node that needs it.
  const Document* openBeside(const Document& from, const Strings& urls, const Node& user);

  /// ROUTE statements in all files.
  std::size_t routes() const;

private:
  std::unique_ptr<Document> read(const std::filesystem::path& file);
  /// Null where the file cannot be read, with a warning the first time. `place` is that of the node that needs it.
  const Document* openOnce(const std::filesystem::path& file, const std::string& place);
  const Document* openNamesake(const std::filesystem::path& folder, std::string_view url, const std::string& place);

  Diagnostics& diagnostics;
  ProgressRange progress;
  std::map<std::filesystem::path, std::unique_ptr<Document>> documents; ///< null: tried in vain
  std::set<std::pair<std::string, std::filesystem::path>> namesakes;    ///< URLs with what is read instead
};

} // namespace atria::vrml
