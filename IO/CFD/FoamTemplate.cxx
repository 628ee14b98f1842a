// SPDX-License-Identifier: GPL-3.0-or-later
#include "FoamTemplate.h"

#include "Support/Error.h"

#include <algorithm>

namespace atria {

namespace {

using ValueOf = std::function<Lines(const std::string& name)>;

constexpr std::string_view opening = "{{";
constexpr std::string_view closing = "}}";
/// Column of the values of entries, from the key on.
constexpr std::size_t valueColumn = 16;

std::size_t endOfName(std::string_view line, std::size_t open)
{
  const std::size_t close = line.find(closing, open);
  if (close == std::string_view::npos)
  {
    throw Error("a name is not closed in the line '" + std::string(line) + "' of a template");
  }
  return close;
}

/// Returns the name that a text consists of, or nothing.
std::string onlyName(std::string_view text)
{
  const bool isName = text.starts_with(opening) && endOfName(text, 0) + closing.size() == text.size();
  return isName ? std::string(text.substr(opening.size(), text.size() - opening.size() - closing.size())) : "";
}

std::string filledLine(std::string_view line, const ValueOf& valueOf)
{
  std::string filled;
  for (std::size_t open = line.find(opening); open != std::string_view::npos; open = line.find(opening))
  {
    const std::size_t close = endOfName(line, open);
    const std::string name(line.substr(open + opening.size(), close - open - opening.size()));
    const Lines value = valueOf(name);
    if (value.size() != 1)
    {
      throw Error("'" + name + "' stands within a line of a template, and has " + std::to_string(value.size()) +
                  " lines");
    }
    filled.append(line.substr(0, open)).append(value[0]);
    line.remove_prefix(close + closing.size());
  }
  return filled.append(line);
}

/// Returns the line of an entry with its value in the usual column, or after one blank behind a long key.
std::string aligned(const std::string& line)
{
  const std::size_t key = line.find_first_not_of(' ');
  const std::size_t end = std::min(line.find(' ', key), line.size());
  const std::size_t value = std::min(line.find_first_not_of(' ', end), line.size());
  std::string moved = line.substr(0, end);
  moved.resize(std::max(key + valueColumn, end + 1), ' ');
  return moved + line.substr(value);
}

/// True for an entry, `key value;`, whose key has a name in it.
bool hasNameInKey(std::string_view entry)
{
  const std::size_t blank = entry.find(' ');
  return entry.ends_with(';') && blank != std::string_view::npos &&
         entry.substr(0, blank).find(opening) != std::string_view::npos;
}

void addFilled(Lines& lines, std::string_view line, const ValueOf& valueOf)
{
  const std::size_t depth = std::min(line.find_first_not_of(' '), line.size());
  const std::string_view text = line.substr(depth);
  if (const std::string name = onlyName(text); !name.empty())
  {
    for (const std::string& value : valueOf(name))
    {
      lines.push_back(value.empty() ? value : std::string(depth, ' ') + value);
    }
    return;
  }
  const std::string filled = filledLine(line, valueOf);
  lines.push_back(hasNameInKey(text) ? aligned(filled) : filled);
}

} // namespace

Lines fillTemplate(std::string_view text, const ValueOf& valueOf)
{
  Lines lines;
  while (!text.empty())
  {
    const std::size_t end = std::min(text.find('\n'), text.size());
    addFilled(lines, text.substr(0, end), valueOf);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string_view foamTemplate(std::string_view name)
{
  const auto found = foamTemplates().find(name);
  if (found == foamTemplates().end())
  {
    throw Error("there is no template '" + std::string(name) + "'");
  }
  return found->second;
}

} // namespace atria
