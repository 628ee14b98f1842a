// SPDX-License-Identifier: GPL-3.0-or-later
/// Selects hours of a weather file by temperature, time of day and month, and counts them.
#pragma once

#include "WeatherFile.h"

#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace atria::weather {

/// Outdoor temperatures, both ends included, degrees Celsius. The default is where natural ventilation is comfortable.
struct TemperatureRange
{
  double least = 18.0;
  double most = 26.0;
};

/// Times of day between two full hours, over midnight if `from` is later than `to`.
struct HoursOfDay
{
  int from = 0;
  int to = 24;
};

enum class Season
{
  Spring,
  Summer,
  Autumn,
  Winter
};

/// One bit a month, January first.
using Months = std::bitset<12>;

/// Returns the three months of a season, that of the southern hemisphere for a negative latitude. In the north spring
/// begins in March.
Months monthsOf(Season season, double latitude);
/// Returns the months of a list such as "4-9", "11-2" (over the new year) or "1,6-8". Throws Error on another text.
Months monthsFrom(std::string_view text);

/// The hours to keep. Without a range all temperatures are kept, unknown ones too.
struct HourFilter
{
  std::optional<TemperatureRange> temperature = std::nullopt;
  HoursOfDay time = {};
  Months months = Months().set();
};

/// Returns the hours that pass the filter, in their order.
std::vector<WeatherHour> hoursKept(const std::vector<WeatherHour>& hours, const HourFilter& filter);

/// Hours in a range of temperatures, of those whose temperature is known.
struct TemperatureCount
{
  std::size_t inRange = 0;
  std::size_t known = 0;
  double share() const { return known > 0 ? static_cast<double>(inRange) / static_cast<double>(known) : 0.0; }
};
TemperatureCount countIn(const std::vector<WeatherHour>& hours, const TemperatureRange& range);

/// Hours that lack a value.
struct MissingHours
{
  std::size_t temperature = 0;
  std::size_t wind = 0; ///< speed, or direction where the speed makes it matter
};
MissingHours missingIn(const std::vector<WeatherHour>& hours, double calmSpeed);

/// True for speeds below `calmSpeed`, m/s, and for no wind at all. Such an hour has no direction.
bool isCalm(double speed, double calmSpeed);
/// True if the wind of an hour is known: it is calm, or has a direction.
bool hasWind(const WeatherHour& hour, double calmSpeed);

} // namespace atria::weather
