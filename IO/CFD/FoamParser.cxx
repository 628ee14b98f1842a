// SPDX-License-Identifier: GPL-3.0-or-later
#include "FoamParser.h"

#include "Support/Error.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstring>
#include <memory>

namespace atria {

namespace {

namespace fs = std::filesystem;

/// Returns the content of a file. zlib reads uncompressed files unchanged.
std::string contentOf(const fs::path& path)
{
  const fs::path zipped = path.string() + ".gz";
  const fs::path& there = fs::exists(path) || !fs::exists(zipped) ? path : zipped;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(there.c_str(), "rb"), gzclose);
  if (!file || fs::is_directory(there))
  {
    throw Error("cannot read '" + there.string() + "'");
  }
  std::string content;
  std::vector<char> part(std::size_t{1} << 20);
  for (int n = 0; (n = gzread(file.get(), part.data(), static_cast<unsigned>(part.size()))) != 0;)
  {
    if (n < 0)
    {
      throw Error("'" + there.string() + "' is damaged: it cannot be decompressed");
    }
    content.append(part.data(), static_cast<std::size_t>(n));
  }
  return content;
}

bool endsWord(char c) { return std::isspace(static_cast<unsigned char>(c)) || std::strchr("(){};\"", c) != nullptr; }

template <typename Value> Value valueAt(const char* bytes)
{
  Value value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

} // namespace

FoamParser::FoamParser(const fs::path& file) : path(file), content(contentOf(file)) { readHeader(); }

void FoamParser::fail(const std::string& what) const
{
  const auto line = 1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  throw Error(path.string() + ":" + std::to_string(line) + ": " + what);
}

void FoamParser::skipSpace()
{
  while (at < content.size())
  {
    const std::size_t before = at;
    while (at < content.size() && std::isspace(static_cast<unsigned char>(content[at])))
    {
      ++at;
    }
    if (content.compare(at, 2, "//") == 0)
    {
      at = std::min(content.find('\n', at), content.size());
    }
    else if (content.compare(at, 2, "/*") == 0)
    {
      const std::size_t end = content.find("*/", at + 2);
      at = end == std::string::npos ? content.size() : end + 2;
    }
    if (at == before)
    {
      return;
    }
  }
}

void FoamParser::readHeader()
{
  if (word() != "FoamFile")
  {
    at = 0;
    fail("this is no file of OpenFOAM: it does not begin with FoamFile");
  }
  const auto header = entries();
  const auto value = [&](const char* key) {
    const auto found = header.find(key);
    return found == header.end() ? std::string() : found->second.text;
  };
  kind = value("class");
  binary = value("format") == "binary";
  const std::string arch = value("arch");
  labelBytes = arch.find("label=64") != std::string::npos ? 8 : 4;
  scalarBytes = arch.find("scalar=32") != std::string::npos ? 4 : 8;
}

bool FoamParser::atEnd()
{
  skipSpace();
  return at == content.size();
}

bool FoamParser::take(char sign)
{
  skipSpace();
  if (at < content.size() && content[at] == sign)
  {
    ++at;
    return true;
  }
  return false;
}

void FoamParser::expect(char sign)
{
  if (!take(sign))
  {
    fail(std::string("expected '") + sign + "'");
  }
}

std::string FoamParser::word()
{
  if (take('"'))
  {
    const std::size_t end = std::min(content.find('"', at), content.size());
    std::string text = content.substr(at, end - at);
    at = std::min(end + 1, content.size());
    return text;
  }
  const std::size_t first = at;
  while (at < content.size() && !endsWord(content[at]))
  {
    ++at;
  }
  if (at == first)
  {
    fail("expected a word");
  }
  return content.substr(first, at - first);
}

template <typename Number> Number FoamParser::number(const char* what)
{
  skipSpace();
  Number value{};
  const char* const first = content.data() + at;
  const char* const last = content.data() + content.size();
  const auto [end, error] = std::from_chars(first, last, value);
  if (error != std::errc() || (end != last && !endsWord(*end)))
  {
    fail(std::string("expected ") + what);
  }
  at += static_cast<std::size_t>(end - first);
  return value;
}

std::int64_t FoamParser::label() { return number<std::int64_t>("an integer"); }

double FoamParser::scalar() { return number<double>("a number"); }

FoamParser::Value FoamParser::untilSemicolon()
{
  skipSpace();
  const std::size_t end = content.find(';', at);
  if (end == std::string::npos)
  {
    fail("expected ';'");
  }
  Value value{content.substr(at, end - at), at};
  at = end + 1;
  return value;
}

std::map<std::string, FoamParser::Value> FoamParser::entries()
{
  std::map<std::string, Value> found;
  expect('{');
  while (!take('}'))
  {
    const std::string key = word();
    found[key] = untilSemicolon();
  }
  return found;
}

std::size_t FoamParser::count()
{
  const std::int64_t number = label();
  if (number < 0 || number >= noIndex)
  {
    fail("a list cannot have " + std::to_string(number) + " entries");
  }
  return static_cast<std::size_t>(number);
}

const char* FoamParser::bytes(std::size_t number)
{
  if (number > content.size() - at)
  {
    fail("the file ends within a list");
  }
  const char* first = content.data() + at;
  at += number;
  return first;
}

std::int64_t FoamParser::rawLabel()
{
  const char* raw = bytes(labelBytes);
  return labelBytes == 8 ? valueAt<std::int64_t>(raw) : valueAt<std::int32_t>(raw);
}

template <typename Entry, typename Raw, typename Text> std::vector<Entry> FoamParser::list(Raw&& raw, Text&& text)
{
  const std::size_t number = count();
  if (take('{')) // the same entry so many times
  {
    std::vector<Entry> same(number, text());
    expect('}');
    return same;
  }
  std::vector<Entry> entries;
  if (number == 0 && !take('('))
  {
    return entries;
  }
  if (number > 0)
  {
    expect('(');
  }
  if (number > content.size() - at)
  {
    fail("the file is too short for a list of " + std::to_string(number));
  }
  entries.reserve(number);
  for (std::size_t i = 0; i < number; ++i)
  {
    entries.push_back(binary ? raw() : text());
  }
  expect(')');
  return entries;
}

std::vector<Index> FoamParser::labels()
{
  const auto checked = [&](std::int64_t value) {
    if (value < 0 || value >= noIndex)
    {
      fail("the label " + std::to_string(value) + " is out of range");
    }
    return static_cast<Index>(value);
  };
  return list<Index>([&] { return checked(rawLabel()); }, [&] { return checked(label()); });
}

std::vector<char> FoamParser::flags()
{
  const auto text = [&]() -> char {
    const std::string told = word();
    return told == "1" || told == "true" || told == "yes" || told == "on" ? 1 : 0;
  };
  return list<char>([&]() -> char { return *bytes(1) != 0 ? 1 : 0; }, text);
}

std::vector<Vec3> FoamParser::vectors()
{
  const auto raw = [&] {
    Vec3 v;
    for (double& x : v)
    {
      const char* const first = bytes(scalarBytes);
      x = scalarBytes == 8 ? valueAt<double>(first) : valueAt<float>(first);
    }
    return v;
  };
  const auto text = [&] {
    expect('(');
    Vec3 v;
    for (double& x : v)
    {
      x = scalar();
    }
    expect(')');
    return v;
  };
  return list<Vec3>(raw, text);
}

} // namespace atria
