// SPDX-License-Identifier: GPL-3.0-or-later
#include "Tmy3File.h"

#include "HourSequence.h"
#include "Support/Text.h"
#include "Support/Utf8.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace atria::weather {

namespace {

constexpr const char* dateName = "Date (MM/DD/YYYY)";
constexpr Quantity temperature{"dry-bulb temperature", "C", -70.0, 70.0, -9900.0};
constexpr Quantity direction{"wind direction", "degrees", 0.0, 360.0, -9900.0};
constexpr Quantity speed{"wind speed", "m/s", 0.0, 40.0, -9900.0};

struct Columns
{
  std::size_t count = 0;
  std::size_t date = 0, time = 0, temperature = 0, direction = 0, speed = 0;
};

Station stationFrom(const LineReader& place)
{
  const std::vector<std::string_view> fields = fieldsOf(place.line());
  if (fields.size() < 7)
  {
    place.fail("the first line has " + std::to_string(fields.size()) +
               " entries instead of 7: number, name, state, time zone, latitude, longitude, elevation");
  }
  Station station;
  station.name = joined({toUtf8(fields[1]), toUtf8(fields[2])});
  station.latitude = numberIn(place, fields[4], "latitude", -90.0, 90.0);
  station.longitude = numberIn(place, fields[5], "longitude", -180.0, 180.0);
  station.elevation = numberFrom(fields[6]).value_or(0.0);
  return station;
}

std::size_t columnNamed(const LineReader& place, const std::vector<std::string_view>& names, const char* wanted)
{
  const auto found =
      std::find_if(names.begin(), names.end(), [&](std::string_view name) { return sameButForCapitals(name, wanted); });
  if (found == names.end())
  {
    place.fail(std::string("there is no column '") + wanted + "'; get the file again");
  }
  return static_cast<std::size_t>(found - names.begin());
}

Columns columnsFrom(const LineReader& place)
{
  const std::vector<std::string_view> names = fieldsOf(place.line());
  const auto named = [&](const char* name) { return columnNamed(place, names, name); };
  return {names.size(),          named(dateName),         named("Time (HH:MM)"),
          named("Dry-bulb (C)"), named("Wdir (degrees)"), named("Wspd (m/s)")};
}

/// Returns the two or three numbers between separators.
std::vector<std::string_view> split(std::string_view text, char separator)
{
  std::vector<std::string_view> parts;
  for (std::size_t start = 0; start <= text.size();)
  {
    const std::size_t end = std::min(text.find(separator, start), text.size());
    parts.push_back(text.substr(start, end - start));
    start = end + 1;
  }
  return parts;
}

void readDate(const LineReader& place, std::string_view field, WeatherHour& record)
{
  const std::vector<std::string_view> parts = split(field, '/');
  if (parts.size() != 3)
  {
    place.fail("the date '" + std::string(field) + "' is not as 12/31/1999");
  }
  record.month = wholeNumberIn(place, parts[0], "month", 1, 12);
  record.day = wholeNumberIn(place, parts[1], "day", 1, daysIn(record.month));
  checkLeapDay(place, parts[2], {record.month, record.day});
}

/// Returns the day before; the one before March 1st is February 28th.
Day dayBefore(const Day& day)
{
  const int month = (day.month + 10) % 12 + 1;
  return day.day > 1 ? Day{day.month, day.day - 1} : Day{month, month == 2 ? 28 : daysIn(month)};
}

/// Sets the hour that ends at or after the time. Midnight may be 24:00 of a day or 00:00 of the next one; then the day
/// is that of the hour before, if there is one.
void readTime(const LineReader& place, std::string_view field, WeatherHour& record, const Day& before)
{
  const std::vector<std::string_view> parts = split(field, ':');
  if (parts.size() != 2)
  {
    place.fail("the time '" + std::string(field) + "' is not as 13:00");
  }
  const int hours = wholeNumberIn(place, parts[0], "hour", 0, 24);
  const int minutes = wholeNumberIn(place, parts[1], "minute", 0, hours == 24 ? 0 : 59);
  record.hour = hours + (minutes > 0 ? 1 : 0);
  if (record.hour == 0)
  {
    const Day day{record.month, record.day};
    const Day ended = isNextDay(before, day) ? before : dayBefore(day);
    record.hour = 24;
    record.month = ended.month;
    record.day = ended.day;
  }
}

WeatherHour recordFrom(const LineReader& place, const Columns& columns, const Day& before)
{
  const std::vector<std::string_view> fields = fieldsOf(place.line());
  if (fields.size() != columns.count)
  {
    place.fail("the line has " + std::to_string(fields.size()) + " columns instead of " +
               std::to_string(columns.count) + "; get the file again, or correct the line");
  }
  WeatherHour record;
  readDate(place, fields[columns.date], record);
  readTime(place, fields[columns.time], record, before);
  record.temperature = valueIn(place, fields[columns.temperature], temperature);
  record.windFrom = valueIn(place, fields[columns.direction], direction);
  record.windSpeed = valueIn(place, fields[columns.speed], speed);
  return record;
}

} // namespace

bool isTmy3(std::string_view secondLine) { return lowered(secondLine).find(lowered(dateName)) != std::string::npos; }

Weather readTmy3(LineReader& lines)
{
  Weather weather;
  weather.format = WeatherFormat::Tmy3;
  weather.station = stationFrom(lines);
  lines.next();
  const Columns columns = columnsFrom(lines);
  HourSequence hours({.source = "TMY3's year"});
  Day day{12, 31};
  while (lines.next())
  {
    const WeatherHour record = recordFrom(lines, columns, day);
    hours.add(record, lines);
    day = {record.month, record.day};
  }
  weather.hours = hours.finish(lines);
  return weather;
}

} // namespace atria::weather
