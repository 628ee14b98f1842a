// SPDX-License-Identifier: GPL-3.0-or-later
#include "DxfFile.h"

#include "CharacterText.h"
#include "ModelParts.h"
#include "ModelText.h"

#include "Support/Error.h"
#include "Support/Text.h"
#include "Support/Utf8.h"

#include <algorithm>
#include <cmath>

namespace atria::model::dxf {

namespace {

/// Marks lines that make no group.
constexpr int noCode = -1000;

const Group* find(std::span<const Group> groups, int code)
{
  const auto found = std::ranges::find(groups, code, &Group::code);
  return found == groups.end() ? nullptr : &*found;
}

/// True for words such as SECTION and 3DFACE, which follow the code 0.
bool isKeyword(std::string_view text)
{
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) {
    return std::isupper(c) != 0 || std::isdigit(c) != 0 || c == '_';
  });
}

} // namespace

std::string_view Entity::text(int code) const
{
  const Group* found = find(groups, code);
  return found ? found->value : std::string_view();
}

bool Entity::has(int code) const { return find(groups, code) != nullptr; }

std::optional<double> Entity::number(int code, double fallback) const
{
  const Group* found = find(groups, code);
  double value = fallback;
  const bool good = !found || (parse(found->value, value) && std::isfinite(value));
  return good ? std::optional(value) : std::nullopt;
}

std::optional<int> Entity::integer(int code, int fallback) const
{
  const Group* found = find(groups, code);
  int value = fallback;
  return !found || parse(found->value, value) ? std::optional(value) : std::nullopt;
}

std::optional<Vec3> Entity::point(int code) const
{
  const auto x = number(code, 0.0);
  const auto y = number(code + 10, 0.0);
  const auto z = number(code + 20, 0.0);
  return x && y && z ? std::optional(Vec3(*x, *y, *z)) : std::nullopt;
}

File::File(const std::string& path) : content(readBytes(path))
{
  if (content.starts_with("AutoCAD Binary DXF"))
  {
    throw Error("'" + path + "' is a binary DXF file, which is not read; save it as a text DXF file");
  }
  readGroups();
  readSections();
  if (own.empty())
  {
    throw Error("'" + path + "' cannot be read as DXF: it has no ENTITIES; export it again, or as OBJ or VRML");
  }
}

/// Reads groups. After a line that is no group code, reading continues at the next entity.
void File::readGroups()
{
  const std::string_view text = content;
  const auto isCode = [](std::string_view line, int& code) { return parse(trimmed(line), code); };
  for (std::size_t at = 0; at < text.size();)
  {
    Group group;
    std::size_t next = at;
    const std::string_view line = nextLine(text, next);
    const std::size_t second = next;
    group.value = next < text.size() ? trimmed(nextLine(text, next)) : std::string_view();
    const bool lost = !groups.empty() && groups.back().code == noCode;
    const bool good = isCode(line, group.code) && (!lost || (group.code == 0 && isKeyword(group.value)));
    if (good)
    {
      if (lost)
      {
        groups.pop_back();
      }
      groups.push_back(group);
      at = next;
      continue;
    }
    skippedLines += trimmed(line).empty() && second >= text.size() ? 0 : 1;
    if (!lost)
    {
      groups.push_back({noCode, {}});
    }
    at = second;
  }
}

void File::readSections()
{
  for (std::size_t i = 0; i + 1 < groups.size(); ++i)
  {
    const bool begins = groups[i].code == 0 && groups[i].value == "SECTION" && groups[i + 1].code == 2;
    if (!begins)
    {
      continue;
    }
    const auto first = groups.begin() + static_cast<std::ptrdiff_t>(i) + 2;
    const auto last = std::find_if(first, groups.end(), [](const Group& group) {
      return group.code == 0 && (group.value == "ENDSEC" || group.value == "EOF" || group.value == "SECTION");
    });
    const std::span<const Group> section(first, last);
    const std::string_view name = groups[i + 1].value;
    if (name == "HEADER")
    {
      readHeader(section);
    }
    else if (name == "BLOCKS")
    {
      readBlocks(section);
    }
    else if (name == "ENTITIES")
    {
      const std::vector<Entity> more = entitiesOf(section);
      own.insert(own.end(), more.begin(), more.end());
    }
  }
}

void File::readHeader(std::span<const Group> section)
{
  for (std::size_t i = 0; i + 1 < section.size(); ++i)
  {
    if (section[i].code == 9)
    {
      header.emplace(section[i].value, section[i + 1].value);
    }
  }
}

std::vector<Entity> File::entitiesOf(std::span<const Group> section)
{
  std::vector<Entity> out;
  for (std::size_t i = 0; i < section.size();)
  {
    const auto rest = section.subspan(i + 1);
    const auto length = static_cast<std::size_t>(std::ranges::find(rest, 0, &Group::code) - rest.begin());
    if (section[i].code == 0)
    {
      out.push_back({section[i].value, rest.first(length)});
    }
    i += 1 + length;
  }
  return out;
}

void File::readBlocks(std::span<const Group> section)
{
  Block* open = nullptr;
  for (const Entity& entity : entitiesOf(section))
  {
    if (entity.type == "BLOCK")
    {
      constexpr int otherFile = 4 | 8;
      open = &blocks[lowered(std::string(entity.text(2)))];
      open->base = entity.point(10).value_or(Vec3::Zero());
      open->isElsewhere = (entity.integer(70, 0).value_or(0) & otherFile) != 0;
    }
    else if (entity.type == "ENDBLK")
    {
      open = nullptr;
    }
    else if (open)
    {
      open->entities.push_back(entity);
    }
  }
}

const Block* File::block(std::string_view name) const
{
  const auto found = blocks.find(lowered(std::string(name)));
  return found == blocks.end() ? nullptr : &found->second;
}

std::string_view File::variable(std::string_view name) const
{
  const auto found = header.find(name);
  return found == header.end() ? std::string_view() : found->second;
}

std::string nameOf(std::string_view text)
{
  constexpr std::size_t length = 7; // length of \U+00E9
  std::string out;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::string_view digits = text.substr(at).starts_with("\\U+") ? text.substr(at + 3, 4) : "";
    unsigned code = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (digits.size() == 4 && error == std::errc{} && stop == digits.data() + 4)
    {
      appendUtf8(out, code);
      at += length;
      continue;
    }
    out += text[at++];
  }
  return toUtf8(out);
}

} // namespace atria::model::dxf
