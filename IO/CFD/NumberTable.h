// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of numbers in text files, such as trees and curves of fans.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace atria {

struct NumberRow
{
  std::size_t line; ///< counted from 1
  std::vector<double> numbers;
};

/// A kind of table.
struct NumberTable
{
  std::string content; ///< content of the file, such as "trees"
  std::string rule;    ///< content of a line, for messages
  std::function<bool(const std::vector<double>&)> isRow;
};

/// Reads lines of numbers with commas, semicolons or blanks between them. Skips blank lines; the first line may name
/// the columns. Throws Error if the file cannot be read or has no rows, and naming a line that is no row.
std::vector<NumberRow> readNumbers(const std::filesystem::path& file, const NumberTable& table);

} // namespace atria
