// SPDX-License-Identifier: GPL-3.0-or-later
/// Opens VRML files, and the files they inline, and keeps them.
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

using scene::Diagnostics;

/// Returns the version that a file's first line declares.
Version versionOf(std::string_view text);

/// Opens files and keeps them: a file inlined many times is read once.
class Library
{
public:
  Library(Diagnostics& messages, const ProgressRange& monitor) : diagnostics(messages), progress(monitor) {}

  /// Returns a document. Throws Error if the file cannot be read or is not VRML, Aborted if the caller stops it.
  const Document& open(const std::filesystem::path& file);

  /// Returns the first of `urls` that can be read, relative to the document that mentions them. If none can, returns a
  /// file of the same name beside that document, with a warning; else null, with another. `user` is the node that needs
  /// it.
  const Document* openBeside(const Document& from, const Strings& urls, const Node& user);

  /// Returns the number of ROUTE statements in all files.
  std::size_t routes() const;

private:
  std::unique_ptr<Document> read(const std::filesystem::path& file);
  /// Returns null if the file cannot be read, with a warning the first time. `place` is that of the node that needs it.
  const Document* openOnce(const std::filesystem::path& file, const std::string& place);
  const Document* openNamesake(const std::filesystem::path& folder, std::string_view url, const std::string& place);

  Diagnostics& diagnostics;
  ProgressRange progress;
  std::map<std::filesystem::path, std::unique_ptr<Document>> documents; ///< null if the file could not be read
  std::set<std::pair<std::string, std::filesystem::path>> namesakes;    ///< URLs with the files read instead
};

} // namespace atria::vrml
