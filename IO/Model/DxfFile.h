// SPDX-License-Identifier: GPL-3.0-or-later
/// The entities of a DXF file in text form, with those of its blocks.
#pragma once

#include "Support/Types.h"

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace atria::model::dxf {

/// A group code and its value, on two lines of the file.
struct Group
{
  int code = 0;
  std::string_view value;
};

/// An entity: its type, and the groups up to the next one.
struct Entity
{
  std::string_view type;
  std::span<const Group> groups;

  /// Returns the first value of a code; empty if there is none.
  std::string_view text(int code) const;
  /// Return the first value of a code as a number: nothing if it is not one, `fallback` if the code is absent.
  std::optional<double> number(int code, double fallback) const;
  std::optional<int> integer(int code, int fallback) const;
  /// Returns the coordinates in `code`, `code` + 10 and `code` + 20; nothing if one of them is no number. Absent
  /// coordinates are 0.
  std::optional<Vec3> point(int code) const;
  bool has(int code) const;
};

/// A list of entities that INSERT places, with the base point for that.
struct Block
{
  Vec3 base = Vec3::Zero();
  std::vector<Entity> entities;
  bool isElsewhere = false; ///< in another file
};

class File
{
public:
  /// Reads a file. Throws Error if it is binary or has no entities.
  explicit File(const std::string& path);

  const std::vector<Entity>& entities() const { return own; }
  /// Returns the block of that name, or null.
  const Block* block(std::string_view name) const;
  /// Returns the first value of a variable of the header.
  std::string_view variable(std::string_view name) const;
  const std::string& bytes() const { return content; }
  /// Returns the number of lines left out for want of a group code.
  std::size_t linesLeftOut() const { return skippedLines; }

private:
  void readGroups();
  void readSections();
  void readHeader(std::span<const Group> section);
  void readBlocks(std::span<const Group> section);
  static std::vector<Entity> entitiesOf(std::span<const Group> section);

  std::string content;
  std::vector<Group> groups;
  std::vector<Entity> own;
  std::map<std::string, Block, std::less<>> blocks; ///< keyed by name in small letters
  std::map<std::string_view, std::string_view> header;
  std::size_t skippedLines = 0;
};

/// Returns a name in UTF-8, with characters that the file writes as \U+00E9.
std::string nameOf(std::string_view text);

} // namespace atria::model::dxf
