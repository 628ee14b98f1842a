// SPDX-License-Identifier: GPL-3.0-or-later
#include "StepText.h"

#include "CharacterText.h"
#include "ModelText.h"

#include "Support/Utf8.h"

#include <algorithm>
#include <cctype>

namespace atria::model::step {

namespace {

constexpr std::string_view space = " \t\r\n\v\f";

std::string_view stripped(std::string_view text)
{
  const std::size_t start = text.find_first_not_of(space);
  return start == text.npos ? std::string_view() : text.substr(start, text.find_last_not_of(space) + 1 - start);
}

/// Returns the end of the string that begins at `at`; the end of the text if it is not closed. Two quotes are one
/// character.
std::size_t endOfString(std::string_view text, std::size_t at)
{
  const std::size_t end = text.find('\'', at + 1);
  return end == text.npos ? text.size() : end + 1;
}

/// Returns the end of the comment that begins at `at`; `at` if none does.
std::size_t endOfComment(std::string_view text, std::size_t at)
{
  if (text.substr(at, 2) != "/*")
  {
    return at;
  }
  const std::size_t end = text.find("*/", at + 2);
  return end == text.npos ? text.size() : end + 2;
}

/// Returns the text without comments and line ends.
std::string onOneLine(std::string_view text)
{
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();)
  {
    if (text[at] == '\'')
    {
      const std::size_t end = endOfString(text, at);
      out.append(text.substr(at, end - at));
      at = end;
    }
    else if (const std::size_t end = endOfComment(text, at); end != at)
    {
      at = end;
    }
    else
    {
      out += space.find(text[at]) == space.npos ? text[at] : ' ';
      ++at;
    }
  }
  out.erase(std::remove(out.begin(), out.end(), '\n'), out.end());
  out.erase(std::remove(out.begin(), out.end(), '\r'), out.end());
  return out;
}

/// Returns the end of the statement that begins at `at`: its semicolon.
std::size_t endOfStatement(std::string_view text, std::size_t at)
{
  while (at < text.size() && text[at] != ';')
  {
    const std::size_t behind = text[at] == '\'' ? endOfString(text, at) : endOfComment(text, at);
    at = behind == at ? at + 1 : behind;
  }
  return at;
}

} // namespace

File::File(std::string_view text)
{
  constexpr std::string_view mark = "\xEF\xBB\xBF"; // byte order mark of UTF-8
  text.remove_prefix(text.starts_with(mark) ? mark.size() : 0);
  bool isData = false;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t end = endOfStatement(text, at);
    const std::string_view statement = stripped(text.substr(at, end - at));
    at = end + 1;
    if (!isData)
    {
      header += onOneLine(statement) + ";\n";
      isData = statement.starts_with("DATA");
    }
    else if (statement.starts_with("ENDSEC"))
    {
      break;
    }
    else
    {
      addStatement(statement);
    }
  }
}

void File::addStatement(std::string_view statement)
{
  while (statement.starts_with("/*"))
  {
    statement = stripped(statement.substr(endOfComment(statement, 0)));
  }
  const std::size_t equals = statement.find('=');
  const std::size_t open = statement.find('(');
  const std::size_t close = statement.rfind(')');
  std::uint64_t id = 0;
  const bool good = statement.starts_with("#") && equals < open && open < close && close != statement.npos &&
                    parse(stripped(statement.substr(1, equals - 1)), id);
  if (!good || !placeOf.try_emplace(id, all.size()).second)
  {
    return;
  }
  std::string type(stripped(statement.substr(equals + 1, open - equals - 1)));
  std::ranges::transform(type, type.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  all.push_back({id, std::move(type), onOneLine(statement.substr(open + 1, close - open - 1))});
  lastId = std::max(lastId, id);
}

Instance* File::find(std::uint64_t id)
{
  const auto found = placeOf.find(id);
  return found == placeOf.end() || isRemoved(all[found->second]) ? nullptr : &all[found->second];
}

const Instance* File::find(std::uint64_t id) const { return const_cast<File*>(this)->find(id); }

const Instance* File::find(std::string_view reference) const
{
  const auto id = referenceIn(reference);
  return id ? find(*id) : nullptr;
}

std::uint64_t File::add(const std::string& type, const std::string& arguments)
{
  placeOf[++lastId] = all.size();
  all.push_back({lastId, type, arguments});
  return lastId;
}

void File::remove(std::uint64_t id)
{
  if (Instance* instance = find(id))
  {
    instance->type.clear();
    instance->arguments.clear();
  }
}

void File::setSchema(const std::string& name)
{
  const std::size_t start = header.find("FILE_SCHEMA");
  if (start != header.npos)
  {
    header.replace(start, header.find(";\n", start) - start, "FILE_SCHEMA(('" + name + "'))");
  }
}

std::string File::text() const
{
  std::string out = header;
  for (const Instance& instance : all)
  {
    if (!isRemoved(instance))
    {
      out += '#' + std::to_string(instance.id) + '=' + instance.type + '(' + instance.arguments + ");\n";
    }
  }
  return out + "ENDSEC;\nEND-ISO-10303-21;\n";
}

std::vector<std::string_view> argumentsOf(std::string_view text)
{
  std::vector<std::string_view> out;
  int depth = 0;
  std::size_t start = 0;
  for (std::size_t at = 0; at < text.size();)
  {
    const char c = text[at];
    depth += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && depth == 0)
    {
      out.push_back(stripped(text.substr(start, at - start)));
      start = at + 1;
    }
    at = c == '\'' ? endOfString(text, at) : at + 1;
  }
  const std::string_view last = stripped(text.substr(start));
  if (!last.empty() || !out.empty())
  {
    out.push_back(last);
  }
  return out;
}

std::string_view insideOf(std::string_view list)
{
  const bool isList = list.size() > 1 && list.front() == '(' && list.back() == ')';
  return isList ? list.substr(1, list.size() - 2) : std::string_view();
}

std::string joinedArguments(const std::vector<std::string_view>& arguments)
{
  std::string out;
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    out.append(i == 0 ? "" : ",").append(arguments[i]);
  }
  return out;
}

std::string_view argument(const Instance& instance, std::size_t i)
{
  const std::vector<std::string_view> all = argumentsOf(instance.arguments);
  return i < all.size() ? all[i] : std::string_view();
}

void setArgument(Instance& instance, std::size_t i, const std::string& value)
{
  const std::string kept = instance.arguments;
  std::vector<std::string_view> all = argumentsOf(kept);
  if (i < all.size())
  {
    all[i] = value;
    instance.arguments = joinedArguments(all);
  }
}

std::string reference(std::uint64_t id) { return "#" + std::to_string(id); }

std::optional<std::uint64_t> referenceIn(std::string_view text)
{
  std::uint64_t id = 0;
  const bool good = text.size() > 1 && text[0] == '#' && parse(text.substr(1), id);
  return good ? std::optional(id) : std::nullopt;
}

void forReferences(std::string_view text, const std::function<void(std::uint64_t)>& visit)
{
  for (std::size_t at = 0; at < text.size();)
  {
    if (text[at] == '\'')
    {
      at = endOfString(text, at);
      continue;
    }
    std::uint64_t id = 0;
    if (text[at++] == '#' && std::from_chars(text.data() + at, text.data() + text.size(), id).ec == std::errc{})
    {
      visit(id);
    }
  }
}

std::optional<double> numberIn(std::string_view text)
{
  // The value may be in parentheses, such as IFCLENGTHMEASURE(0.3048).
  const std::size_t open = text.find('(');
  const std::string_view plain = open == text.npos || text.empty() || text.back() != ')'
                                     ? text
                                     : stripped(text.substr(open + 1, text.size() - open - 2));
  double value = 0.0;
  return parse(plain, value) ? std::optional(value) : std::nullopt;
}

std::string stringIn(std::string_view text)
{
  if (text.size() < 2 || text.front() != '\'' || text.back() != '\'')
  {
    return {};
  }
  text = text.substr(1, text.size() - 2);
  std::string out;
  const auto hexadecimal = [](std::string_view digits) {
    unsigned value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value;
  };
  for (std::size_t at = 0; at < text.size();)
  {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("''"))
    {
      out += '\'';
      at += 2;
    }
    else if (rest.starts_with("\\X2\\"))
    {
      const std::size_t end = std::min(rest.find("\\X0\\"), rest.size());
      for (std::size_t k = 4; k + 4 <= end; k += 4)
      {
        appendUtf8(out, hexadecimal(rest.substr(k, 4)));
      }
      at += std::min(end + 4, rest.size());
    }
    else if (rest.starts_with("\\X\\") && rest.size() >= 5)
    {
      appendUtf8(out, hexadecimal(rest.substr(3, 2)));
      at += 5;
    }
    else if (rest.starts_with("\\S\\") && rest.size() >= 4)
    {
      appendUtf8(out, 0x80u + static_cast<unsigned char>(rest[3]));
      at += 4;
    }
    else
    {
      out += rest.front();
      ++at;
    }
  }
  return toUtf8(out);
}

} // namespace atria::model::step
