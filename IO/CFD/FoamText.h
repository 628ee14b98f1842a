// SPDX-License-Identifier: GPL-3.0-or-later
/// Text of OpenFOAM's dictionaries, laid out as people write them.
#pragma once

#include "Support/Types.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace atria {

class FoamText
{
public:
  /// Adds `key value;`, with values in one column.
  FoamText& entry(std::string_view key, std::string_view value);
  FoamText& entry(std::string_view key, double value);
  /// Add `name { ...` and `}`.
  FoamText& open(std::string_view name);
  FoamText& close();
  FoamText& blank();
  FoamText& comment(std::string_view text);
  /// Adds a line unchanged.
  FoamText& line(std::string_view text);

  const std::string& text() const { return written; }

private:
  FoamText& indent();

  std::string written;
  std::size_t depth = 0;
};

/// Returns the shortest digits that read back to the same value; a zero without sign.
std::string foamNumber(double value);
/// Returns `(x y z)`.
std::string foamVector(const Vec3& v);
/// Returns `(a b c)`.
std::string foamList(std::span<const std::string> words);

/// Writes a file of a case with OpenFOAM's header; `location` is its folder within the case. Makes the folder. Throws
/// Error naming the file.
void writeFoamFile(const std::filesystem::path& caseFolder, std::string_view location, std::string_view name,
                   std::string_view className, const FoamText& content);
/// Writes a file beside its place and moves it there. Throws Error naming the file.
void writePlainFile(const std::filesystem::path& path, std::string_view content);

} // namespace atria
