// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads weather files, EnergyPlus's EPW and NREL's TMY3, as a list of hours.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace atria::weather {

enum class WeatherFormat
{
  Epw,
  Tmy3
};

struct Station
{
  std::string name;       ///< place, region and country, in UTF-8
  double latitude = 0.0;  ///< degrees, negative in the south
  double longitude = 0.0; ///< degrees, negative in the west
  double elevation = 0.0; ///< meters
};

/// Values of one hour. A value that the file marks as missing is absent.
struct WeatherHour
{
  int month = 1;
  int day = 1;
  int hour = 1;                      ///< 1 to 24: the hour that ends then
  std::optional<double> temperature; ///< dry bulb, degrees Celsius
  std::optional<double> windFrom;    ///< 0 to 360, degrees clockwise from north
  std::optional<double> windSpeed;   ///< m/s
};

struct Weather
{
  WeatherFormat format = WeatherFormat::Epw;
  Station station;
  std::vector<WeatherHour> hours; ///< in the order of the file
};

/// Returns the format of a text by its first two lines; nothing if it is no weather.
std::optional<WeatherFormat> formatOf(std::string_view text);

/// True if a file can be read and has such a beginning.
bool isWeather(const std::filesystem::path& file);

/// Returns what a weather file holds. The format follows from the first two lines.
///
/// Several records of an hour are averaged, as the statistics are those of hourly means. Hours must follow each other
/// and fill the file's periods. Years only say whether there is a February 29th, as typical years mix them.
/// \throws Error that names the file and the line, and says what to do.
/// \see EnergyPlus, Auxiliary Programs, "EnergyPlus Weather File (EPW) Data Dictionary"; Wilcox, Marion 2008: Users
///      Manual for TMY3 Data Sets, NREL/TP-581-43156.
Weather readWeather(const std::filesystem::path& file);

/// Returns the same for a text in memory; `file` is its name in messages.
Weather weatherFrom(std::string_view text, const std::string& file);

} // namespace atria::weather
