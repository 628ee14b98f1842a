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

  /// The first value of a code; empty where there is none.
  std::string_view text(int code) const;
  /// The first value of a code as a number; nothing where it is none, `fallback` where the code is absent.
  std::optional<double> number(int code, double fallback) const;
  std::optional<int> integer(int code, int fallback) const;
  /// The coordinates in `code`, `code` + 10 and `code` + 20; nothing where one of them is no number. What is absent is
  /// 0.
  std::optional<Vec3> point(int code) const;
  bool has(int code) const;
};

/// A list of entities with a point of its own that INSERT puts where it says.
struct Block
{
  Vec3 base = Vec3::Zero();
  std::vector<Entity> entities;
  bool isElsewhere = false; ///< in another file
};

class File
{
public:
  /// Throws Error where it is binary or has no entities.
  explicit File(const std::string& path);

  const std::vector<Entity>& entities() const { return own; }
  /// Null where there is none of that name.
  const Block* block(std::string_view name) const;
  /// Per variable of the header its first value.
  std::string_view variable(std::string_view name) const;
  const std::string& bytes() const { return content; }
  /// Lines left out because no group code was where one should be.
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
  std::map<std::string, Block, std::less<>> blocks; ///< by name in small letters
  std::map<std::string_view, std::string_view> header;
  std::size_t skippedLines = 0;
};

/// A name in UTF-8, with characters that the file writes as \U+00E9.
std::string nameOf(std::string_view text);

} // namespace atria::model::dxf
