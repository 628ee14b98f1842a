// SPDX-License-Identifier: GPL-3.0-or-later
#include "WeatherText.h"

#include "Support/Error.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

namespace atria::weather {

namespace {

constexpr std::string_view blanks = " \t\v\f\r";
constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

std::string quoted(std::string_view text)
{
  constexpr std::size_t most = 40; // a broken file may hold anything
  return "'" + std::string(text.substr(0, most)) + (text.size() > most ? "…'" : "'");
}

std::string_view withoutQuotes(std::string_view field)
{
  const bool isQuoted = field.size() >= 2 && field.front() == '"' && field.back() == '"';
  return isQuoted ? trimmed(field.substr(1, field.size() - 2)) : field;
}

/// True for nothing but nines, such as 99.90 or -9999, beyond the code for a missing value.
bool isNines(std::string_view field, const Quantity& quantity, double value)
{
  const bool isBeyond = quantity.missing > 0.0 ? value >= quantity.missing : value <= quantity.missing;
  field.remove_prefix(field.starts_with('+') || field.starts_with('-') ? 1 : 0);
  if (field.find('.') != field.npos)
  {
    field = field.substr(0, field.find_last_not_of('0') + 1);
  }
  return isBeyond && field.find_first_not_of("9.") == field.npos;
}

bool isMissing(std::string_view field, const Quantity& quantity, double value)
{
  return value == quantity.missing || isNines(field, quantity, value);
}

std::string adviceFor(const Quantity& quantity)
{
  return "; where it is not known, write " + shortNumber(quantity.missing);
}

} // namespace

LineReader::LineReader(std::string_view all, std::string ofFile) : rest(all), name(std::move(ofFile))
{
  if (rest.starts_with(byteOrderMark))
  {
    rest.remove_prefix(byteOrderMark.size());
  }
}

bool LineReader::next()
{
  while (!rest.empty())
  {
    const std::size_t end = rest.find('\n');
    current = trimmed(rest.substr(0, end));
    rest.remove_prefix(end == rest.npos ? rest.size() : end + 1);
    ++count;
    if (!current.empty())
    {
      return true;
    }
  }
  return false;
}

void LineReader::fail(const std::string& problem) const
{
  throw Error(name + ":" + std::to_string(count) + ": " + problem);
}

std::string_view trimmed(std::string_view text)
{
  const std::size_t start = text.find_first_not_of(blanks);
  return start == text.npos ? std::string_view() : text.substr(start, text.find_last_not_of(blanks) + 1 - start);
}

std::vector<std::string_view> fieldsOf(std::string_view line)
{
  std::vector<std::string_view> fields;
  bool inQuotes = false;
  std::size_t start = 0;
  for (std::size_t at = 0; at <= line.size(); ++at)
  {
    if (at == line.size() || (line[at] == ',' && !inQuotes))
    {
      fields.push_back(withoutQuotes(trimmed(line.substr(start, at - start))));
      start = at + 1;
    }
    else if (line[at] == '"')
    {
      inQuotes = !inQuotes;
    }
  }
  return fields;
}

std::optional<double> numberFrom(std::string_view text)
{
  if (text.starts_with('+'))
  {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool isNumber = error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
  return isNumber ? std::optional(value) : std::nullopt;
}

double numberIn(const LineReader& place, std::string_view field, const char* name, double least, double most)
{
  const std::optional<double> value = numberFrom(field);
  if (!value)
  {
    place.fail(std::string("the ") + name + ", " + quoted(field) + ", is no number");
  }
  if (*value < least || *value > most)
  {
    place.fail(std::string("the ") + name + ", " + shortNumber(*value) + ", is not from " + shortNumber(least) +
               " to " + shortNumber(most));
  }
  return *value;
}

int wholeNumberIn(const LineReader& place, std::string_view field, const char* name, int least, int most)
{
  const double value = numberIn(place, field, name, least, most);
  if (value != std::floor(value))
  {
    place.fail(std::string("the ") + name + ", " + shortNumber(value) + ", is no whole number");
  }
  return static_cast<int>(value);
}

std::optional<double> valueIn(const LineReader& place, std::string_view field, const Quantity& quantity)
{
  if (field.empty())
  {
    return std::nullopt;
  }
  const std::optional<double> value = numberFrom(field);
  if (!value)
  {
    place.fail(std::string("the ") + quantity.name + ", " + quoted(field) + ", is no number" + adviceFor(quantity));
  }
  if (isMissing(field, quantity, *value))
  {
    return std::nullopt;
  }
  if (*value < quantity.least || *value > quantity.most)
  {
    place.fail(std::string("the ") + quantity.name + ", " + shortNumber(*value) + " " + quantity.unit +
               ", is not from " + shortNumber(quantity.least) + " to " + shortNumber(quantity.most) +
               adviceFor(quantity));
  }
  return value;
}

std::string shortNumber(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

std::string bytesOf(const std::string& file)
{
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
  {
    throw Error("'" + file + "' does not exist or is not a file");
  }
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in.good() && !in.eof())
  {
    throw Error("'" + file + "' cannot be read; check permissions");
  }
  return bytes;
}

} // namespace atria::weather
