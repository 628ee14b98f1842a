// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "Diagnostics.h"
#include "SceneGraph.h"

#include "Support/Progress.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
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

  /// The first of `urls` that can be read, relative to the document that mentions them; null and a warning if
  /// none can. `user` is the node that needs it.
  const Document* openBeside(const Document& from, const Strings& urls, const Node& user);

  /// ROUTE statements in all files.
  std::size_t routes() const;

private:
  std::unique_ptr<Document> read(const std::filesystem::path& file);

  Diagnostics& diagnostics;
  ProgressRange progress;
  std::map<std::filesystem::path, std::unique_ptr<Document>> documents; ///< null: tried in vain
};

} // namespace atria::vrml
