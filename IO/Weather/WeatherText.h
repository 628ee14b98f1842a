// SPDX-License-Identifier: GPL-3.0-or-later
/// Lines, fields and numbers of tables in text, with errors that name file and line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace atria::weather {

/// Goes through a text line by line. Lines end with LF or CRLF. Blank lines are skipped, and so is a byte order mark.
class LineReader
{
public:
  LineReader(std::string_view all, std::string ofFile);

  /// Goes to the next line. Returns false at the end of the text.
  bool next();
  std::string_view line() const { return current; }
  std::size_t number() const { return count; }
  const std::string& file() const { return name; }
  /// Throws Error with the file's name and the current line's number ahead of the problem.
  [[noreturn]] void fail(const std::string& problem) const;

private:
  std::string_view rest;
  std::string_view current;
  std::string name;
  std::size_t count = 0;
};

/// A measured quantity: its unit, its range, and the number that stands for a missing value, which is out of range.
/// More nines than that number has stand for a missing value, too, such as 999 for 99.9.
struct Quantity
{
  const char* name;
  const char* unit;
  double least;
  double most;
  double missing;
};

/// Returns the text without blanks around it.
std::string_view trimmed(std::string_view text);

/// Returns what stands between commas, without blanks and without the quotes around a field. Commas in quotes divide
/// nothing.
std::vector<std::string_view> fieldsOf(std::string_view line);

/// Returns the number that the whole text is; nothing if it is none or not finite.
std::optional<double> numberFrom(std::string_view text);

/// Return the number in a field. Throw Error if there is none, or if it is out of range.
double numberIn(const LineReader& place, std::string_view field, const char* name, double least, double most);
int wholeNumberIn(const LineReader& place, std::string_view field, const char* name, int least, int most);

/// Returns the value in a field; nothing if it is missing or the field is empty. Throws Error as above.
std::optional<double> valueIn(const LineReader& place, std::string_view field, const Quantity& quantity);

/// Returns up to six digits of a number for a message.
std::string shortNumber(double value);

/// Returns all bytes of a file. Throws Error if it cannot be read.
std::string bytesOf(const std::string& file);

} // namespace atria::weather
