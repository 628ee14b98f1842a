// SPDX-License-Identifier: GPL-3.0-or-later
#include "NumberTable.h"

#include "Support/Error.h"

#include <algorithm>
#include <fstream>
#include <locale>
#include <sstream>

namespace atria {

namespace {

/// Returns the numbers of a line; nothing if it has others than numbers.
std::vector<double> numbersIn(std::string line)
{
  std::ranges::replace_if(
      line, [](char c) { return c == ',' || c == ';' || c == '\r'; }, ' ');
  std::istringstream in(line);
  in.imbue(std::locale::classic());
  std::vector<double> numbers;
  for (double number = 0.0; in >> number;)
  {
    numbers.push_back(number);
  }
  return in.eof() ? numbers : std::vector<double>();
}

} // namespace

std::vector<NumberRow> readNumbers(const std::filesystem::path& file, const NumberTable& table)
{
  std::ifstream in(file);
  if (!in)
  {
    throw Error("cannot read the " + table.content + " of '" + file.string() + "'");
  }
  std::vector<NumberRow> rows;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number)
  {
    if (number == 1 && line.starts_with("\xEF\xBB\xBF"))
    {
      line.erase(0, 3); // a byte order mark
    }
    NumberRow row{number, numbersIn(line)};
    const bool isHeader = number == 1 && line.find_first_of("0123456789") != line.find_first_not_of(" \t\"+-.");
    const bool isBlank = line.find_first_not_of(" \t\r") == std::string::npos;
    if (table.isRow(row.numbers))
    {
      rows.push_back(std::move(row));
    }
    else if (!isBlank && !isHeader)
    {
      throw Error("'" + file.string() + "', line " + std::to_string(number) + ": " + table.rule);
    }
  }
  if (rows.empty())
  {
    throw Error("'" + file.string() + "' has no " + table.content);
  }
  return rows;
}

} // namespace atria
