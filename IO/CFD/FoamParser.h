// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads OpenFOAM's files: tokens, dictionaries' entries and lists, ascii or binary, plain or compressed by gzip.
#pragma once

#include "Support/Types.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace atria {

/// A file of a polyMesh, read from its beginning. All that fails throws Error naming file and line.
class FoamParser
{
public:
  /// Reads `path`, or `path`.gz where it is not there, and the header FoamFile.
  explicit FoamParser(const std::filesystem::path& path);

  /// Of the header: what kind of content it is.
  const std::string& className() const { return kind; }

  /// Whether nothing but space and comments is left.
  bool atEnd();
  /// Whether the next sign is this; it is taken then.
  bool take(char sign);
  void expect(char sign);
  /// A name, a number or a text in quotes, without these.
  std::string word();
  std::int64_t label();
  double scalar();
  /// An entry's value, up to ';', as it stands there, and where.
  struct Value
  {
    std::string text;
    std::size_t offset = 0;
  };
  Value untilSemicolon();
  /// `{ key value; ... }` without dictionaries in it.
  std::map<std::string, Value> entries();

  std::vector<Index> labels();
  /// 0 or 1 each.
  std::vector<char> flags();
  std::vector<Vec3> vectors();

  /// The whole file.
  const std::string& text() const { return content; }

  [[noreturn]] void fail(const std::string& what) const;

private:
  void skipSpace();
  void readHeader();
  template <typename Number> Number number(const char* what);
  /// The number of a list's entries, which is refused where the file is too short for as many.
  std::size_t count();
  /// A list of what `one` reads; `N{value}` is N times the same.
  template <typename Entry, typename Raw, typename Text> std::vector<Entry> list(Raw&& raw, Text&& text);
  const char* bytes(std::size_t number);
  std::int64_t rawLabel();

  std::filesystem::path path;
  std::string content;
  std::size_t at = 0;
  std::string kind;
  bool binary = false;
  std::size_t labelBytes = 4;
  std::size_t scalarBytes = 8;
};

} // namespace atria
