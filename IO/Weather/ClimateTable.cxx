// SPDX-License-Identifier: GPL-3.0-or-later
#include "ClimateTable.h"

#include "Support/Error.h"
#include "WeatherFile.h"
#include "WeatherText.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>

namespace atria::weather {

namespace {

using nlohmann::json;

constexpr std::array columns{"from", "frequency", "scale", "shape"};
/// Returns the number in a column of a row; nothing if there is none.
using Row = std::function<std::optional<double>(const char*)>;

ClimateSector sectorFrom(const Row& row, const std::string& where)
{
  std::array<double, columns.size()> values{};
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const std::optional<double> value = row(columns[i]);
    if (!value)
    {
      throw Error(where + ": '" + columns[i] + "' is missing or no number; columns are from, frequency, scale, shape");
    }
    values[i] = *value;
  }
  if (values[1] < 0.0 || values[2] <= 0.0 || values[3] <= 0.0)
  {
    throw Error(where + ": frequencies must not be negative, scale and shape must be more than 0");
  }
  const double turned = std::fmod(values[0], 360.0);
  return {turned < 0.0 ? turned + 360.0 : turned, values[1], values[2], values[3]};
}

std::string placeOf(const std::string& file, std::size_t row) { return file + ", sector " + std::to_string(row + 1); }

std::vector<ClimateSector> fromJson(const std::string& text, const std::string& file)
{
  const json rows = json::parse(text, nullptr, false);
  if (!rows.is_array())
  {
    throw Error(file + ": this is no list of sectors in JSON, such as [{\"from\": 0, \"frequency\": 1, \"scale\": 4, "
                       "\"shape\": 2}]");
  }
  std::vector<ClimateSector> table;
  for (const json& row : rows)
  {
    const auto number = [&](const char* name) {
      const bool isThere = row.is_object() && row.contains(name) && row[name].is_number();
      return isThere ? std::optional(row[name].get<double>()) : std::nullopt;
    };
    table.push_back(sectorFrom(number, placeOf(file, table.size())));
  }
  return table;
}

std::vector<ClimateSector> fromCsv(const std::string& text, const std::string& file)
{
  LineReader lines(text, file);
  lines.next();
  const std::vector<std::string_view> names = fieldsOf(lines.line());
  std::vector<ClimateSector> table;
  while (lines.next())
  {
    const std::vector<std::string_view> fields = fieldsOf(lines.line());
    const auto number = [&](const char* name) {
      const auto column = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
      return column < fields.size() ? numberFrom(fields[column]) : std::nullopt;
    };
    table.push_back(sectorFrom(number, placeOf(file, table.size())));
  }
  return table;
}

/// Divides frequencies, which are shares or percent, by their sum.
void normalize(std::vector<ClimateSector>& table, const std::string& file)
{
  double total = 0.0;
  for (const ClimateSector& sector : table)
  {
    total += sector.frequency;
  }
  constexpr double largestSumOfShares = 10.0;
  constexpr double tolerance = 0.02; // tables are rounded
  const double whole = total > largestSumOfShares ? 100.0 : 1.0;
  if (!(std::abs(total / whole - 1.0) <= tolerance))
  {
    throw Error(file + ": frequencies sum up to " + shortNumber(total) + " instead of 1 or 100");
  }
  for (ClimateSector& sector : table)
  {
    sector.frequency /= total;
  }
}

/// Throws Error for a direction that stands twice. Directions count to a tenth of a degree, as in the names of runs.
void checkDirections(const std::vector<ClimateSector>& table, const std::string& file)
{
  std::map<double, std::size_t> sectorOf;
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    const double tenths = std::fmod(std::floor(10.0 * table[i].from + 0.5), 3600.0);
    const auto [found, isNew] = sectorOf.emplace(tenths, i);
    if (!isNew)
    {
      throw Error(placeOf(file, i) + ": sector " + std::to_string(found->second + 1) + " has the direction " +
                  shortNumber(tenths / 10.0) + ", too; give each direction once");
    }
  }
}

} // namespace

std::vector<ClimateSector> tableOf(const WindRose& rose)
{
  std::vector<ClimateSector> table;
  for (const RoseSector& sector : rose.sectors)
  {
    table.push_back({sector.from, sector.frequency, sector.weibull.scale, sector.weibull.shape});
  }
  return table;
}

std::string csvOf(const std::vector<ClimateSector>& table)
{
  std::string text = "from,frequency,scale,shape\n";
  for (const ClimateSector& sector : table)
  {
    char row[128];
    std::snprintf(row, sizeof row, "%.6g,%.6f,%.4f,%.4f\n", sector.from, sector.frequency, sector.scale, sector.shape);
    text += row;
  }
  return text;
}

std::vector<ClimateSector> readClimateTable(const std::filesystem::path& file)
{
  const std::string name = file.string();
  const std::string text = bytesOf(name);
  if (formatOf(text))
  {
    throw Error(name + " is a weather file and no table of the wind: make the table of it first, by `atria climate`");
  }
  std::vector<ClimateSector> table = file.extension() == ".json" ? fromJson(text, name) : fromCsv(text, name);
  if (table.empty())
  {
    throw Error(name + ": holds no sectors of wind; columns are from, frequency, scale, shape");
  }
  checkDirections(table, name);
  normalize(table, name);
  return table;
}

std::vector<double> directionsOf(const std::vector<ClimateSector>& table)
{
  std::vector<double> directions;
  for (const ClimateSector& sector : table)
  {
    if (sector.frequency > 0.0)
    {
      directions.push_back(sector.from);
    }
  }
  return directions;
}

} // namespace atria::weather
