// SPDX-License-Identifier: GPL-3.0-or-later
#include "EpwFile.h"

#include "EpwPeriods.h"
#include "HourSequence.h"
#include "Support/Text.h"
#include "Support/Utf8.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace atria::weather {

namespace {

// The line of daylight saving is spelled with and without s at its end.
constexpr std::array linesAfterLocation{"DESIGN CONDITIONS",   "TYPICAL/EXTREME PERIODS",
                                        "GROUND TEMPERATURES", "HOLIDAYS/DAYLIGHT SAVING",
                                        "COMMENTS 1",          "COMMENTS 2",
                                        "DATA PERIODS"};
// Files before 2005 lack the last three of 35 columns.
constexpr std::size_t fewestColumns = 32;
constexpr std::size_t mostColumns = 35;
constexpr std::size_t yearColumn = 0;
constexpr std::size_t monthColumn = 1;
constexpr std::size_t temperatureColumn = 6;
constexpr std::size_t directionColumn = 20;
constexpr std::size_t speedColumn = 21;
constexpr Quantity temperature{"dry-bulb temperature", "C", -70.0, 70.0, 99.9};
constexpr Quantity direction{"wind direction", "degrees", 0.0, 360.0, 999.0};
constexpr Quantity speed{"wind speed", "m/s", 0.0, 40.0, 999.0};

/// Returns the texts that are given, with commas between.
std::string placeName(const std::vector<std::string_view>& texts)
{
  std::vector<std::string> given;
  for (const std::string_view text : texts)
  {
    if (!text.empty() && text != "-" && lowered(text) != "unknown")
    {
      given.push_back(toUtf8(text));
    }
  }
  return given.empty() ? "unnamed place" : joined(given);
}

Station stationFrom(const LineReader& place)
{
  const std::vector<std::string_view> fields = fieldsOf(place.line());
  if (fields.size() < 10)
  {
    place.fail("LOCATION has " + std::to_string(fields.size() - 1) +
               " entries instead of 9: city, region, country, source, WMO number, latitude, longitude, time zone, "
               "elevation");
  }
  Station station;
  station.name = placeName({fields[1], fields[2], fields[3]});
  station.latitude = numberIn(place, fields[6], "latitude", -90.0, 90.0);
  station.longitude = numberIn(place, fields[7], "longitude", -180.0, 180.0);
  station.elevation = numberFrom(fields[9]).value_or(0.0);
  return station;
}

/// Goes to the next line of the header and checks how it begins.
void goToHeaderLine(LineReader& lines, const std::string& name)
{
  if (!lines.next())
  {
    lines.fail("the file ends in its header, before " + name + "; get it again");
  }
  if (!lowered(lines.line()).starts_with(lowered(name)))
  {
    lines.fail("the line " + name +
               " of the header is not here; an EPW file begins with eight lines, LOCATION to "
               "DATA PERIODS: get the file again");
  }
}

WeatherHour recordFrom(const LineReader& place, const std::vector<std::string_view>& fields)
{
  WeatherHour record;
  record.month = wholeNumberIn(place, fields[monthColumn], "month", 1, 12);
  record.day = wholeNumberIn(place, fields[monthColumn + 1], "day", 1, daysIn(record.month));
  checkLeapDay(place, fields[yearColumn], {record.month, record.day});
  record.hour = wholeNumberIn(place, fields[monthColumn + 2], "hour", 1, 24);
  record.temperature = valueIn(place, fields[temperatureColumn], temperature);
  record.windFrom = valueIn(place, fields[directionColumn], direction);
  record.windSpeed = valueIn(place, fields[speedColumn], speed);
  return record;
}

} // namespace

bool isEpw(std::string_view firstLine) { return lowered(firstLine).starts_with("location,"); }

Weather readEpw(LineReader& lines)
{
  Weather weather;
  weather.station = stationFrom(lines);
  for (const char* name : linesAfterLocation)
  {
    goToHeaderLine(lines, name);
  }
  HourSequence hours(planFrom(lines));
  std::size_t columns = 0; // as many as the first record has
  while (lines.next())
  {
    const std::vector<std::string_view> fields = fieldsOf(lines.line());
    columns = columns == 0 ? std::clamp(fields.size(), fewestColumns, mostColumns) : columns;
    if (fields.size() != columns)
    {
      lines.fail("the line has " + std::to_string(fields.size()) + " columns instead of " + std::to_string(columns) +
                 "; get the file again, or correct the line");
    }
    hours.add(recordFrom(lines, fields), lines);
  }
  weather.hours = hours.finish(lines);
  return weather;
}

} // namespace atria::weather
