// SPDX-License-Identifier: GPL-3.0-or-later
#include "WeatherHours.h"

#include "Support/Error.h"
#include "WeatherText.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace atria::weather {

namespace {

/// Sets the months from one to another, both included, over the new year if need be.
void setMonths(Months& months, int first, int last)
{
  for (int month = first; month != last; month = month % 12 + 1)
  {
    months.set(static_cast<std::size_t>(month - 1));
  }
  months.set(static_cast<std::size_t>(last - 1));
}

int monthFrom(std::string_view word, std::string_view text)
{
  const double month = numberFrom(trimmed(word)).value_or(0.0);
  if (month < 1.0 || month > 12.0 || month != std::floor(month))
  {
    throw Error("'" + std::string(text) + "' names no months; write numbers from 1 to 12, such as 4-9 or 1,2,12");
  }
  return static_cast<int>(month);
}

/// True if the hour, which begins at `hour` - 1, lies between the times.
bool isIn(int hour, const HoursOfDay& time)
{
  const bool isAfter = hour - 1 >= time.from;
  const bool isBefore = hour <= time.to;
  return time.from < time.to ? isAfter && isBefore : isAfter || isBefore;
}

bool isIn(const std::optional<double>& temperature, const TemperatureRange& range)
{
  return temperature && *temperature >= range.least && *temperature <= range.most;
}

bool passes(const WeatherHour& hour, const HourFilter& filter)
{
  return filter.months.test(static_cast<std::size_t>(hour.month - 1)) && isIn(hour.hour, filter.time) &&
         (!filter.temperature || isIn(hour.temperature, *filter.temperature));
}

} // namespace

Months monthsOf(Season season, double latitude)
{
  const int inNorth = 3 + 3 * static_cast<int>(season);
  const int shifted = inNorth + (latitude < 0.0 ? 6 : 0);
  const int first = (shifted - 1) % 12 + 1;
  Months months;
  setMonths(months, first, (first + 1) % 12 + 1);
  return months;
}

Months monthsFrom(std::string_view text)
{
  Months months;
  for (const std::string_view part : fieldsOf(text))
  {
    const std::size_t dash = part.find('-');
    const int first = monthFrom(part.substr(0, dash), text);
    setMonths(months, first, dash == part.npos ? first : monthFrom(part.substr(dash + 1), text));
  }
  return months;
}

std::vector<WeatherHour> hoursKept(const std::vector<WeatherHour>& hours, const HourFilter& filter)
{
  std::vector<WeatherHour> kept;
  std::copy_if(hours.begin(), hours.end(), std::back_inserter(kept),
               [&](const WeatherHour& hour) { return passes(hour, filter); });
  return kept;
}

TemperatureCount countIn(const std::vector<WeatherHour>& hours, const TemperatureRange& range)
{
  TemperatureCount count;
  for (const WeatherHour& hour : hours)
  {
    count.known += hour.temperature ? 1 : 0;
    count.inRange += isIn(hour.temperature, range) ? 1 : 0;
  }
  return count;
}

MissingHours missingIn(const std::vector<WeatherHour>& hours, double calmSpeed)
{
  MissingHours missing;
  for (const WeatherHour& hour : hours)
  {
    missing.temperature += hour.temperature ? 0 : 1;
    missing.wind += hasWind(hour, calmSpeed) ? 0 : 1;
  }
  return missing;
}

bool isCalm(double speed, double calmSpeed) { return speed < calmSpeed || speed == 0.0; }

bool hasWind(const WeatherHour& hour, double calmSpeed)
{
  return hour.windSpeed && (hour.windFrom || isCalm(*hour.windSpeed, calmSpeed));
}

} // namespace atria::weather
