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

/// A file of a polyMesh, read from its beginning. All failures throw Error naming file and line.
class FoamParser
{
public:
  /// Reads `path`, or `path`.gz if `path` does not exist, and the header FoamFile.
  explicit FoamParser(const std::filesystem::path& path);

  /// Returns the kind of content that the header states.
  const std::string& className() const { return kind; }

  /// True if only blanks and comments are left.
  bool atEnd();
  /// Returns true and moves past the next sign if it is this one.
  bool take(char sign);
  void expect(char sign);
  /// Reads a name, a number or a text in quotes, and returns it without the quotes.
  std::string word();
  std::int64_t label();
  double scalar();
  /// An entry's value up to ';', unchanged, and its place in the file.
  struct Value
  {
    std::string text;
    std::size_t offset = 0;
  };
  Value untilSemicolon();
  /// Reads `{ key value; ... }`; nested dictionaries are not accepted.
  std::map<std::string, Value> entries();

  std::vector<Index> labels();
  /// Reads a list of flags, 0 or 1 each.
  std::vector<char> flags();
  std::vector<Vec3> vectors();

  /// Returns the whole file.
  const std::string& text() const { return content; }

  [[noreturn]] void fail(const std::string& what) const;

private:
  void skipSpace();
  void readHeader();
  template <typename Number> Number number(const char* what);
  /// Reads the number of a list's entries. Fails if it is negative or too large.
  std::size_t count();
  /// Reads a list, entry by entry with `raw` or `text`; `N{value}` is N times the same.
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
