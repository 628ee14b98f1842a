// SPDX-License-Identifier: GPL-3.0-or-later
#include "WeatherSamples.h"

#include <array>
#include <cstdio>

namespace atria::testing {

namespace {

std::string number(const std::optional<double>& value, const char* missing)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value.value_or(0.0));
  return value ? text : missing;
}

/// Returns a year that differs from month to month, as in typical years. February's is a leap year.
int yearOfMonth(int month) { return 1990 + month * 3 % 11; }

std::string epwLine(const WeatherHour& hour)
{
  char start[64];
  std::snprintf(start, sizeof start, "%d,%d,%d,%d,60,", yearOfMonth(hour.month), hour.month, hour.day, hour.hour);
  return start + std::string("A7A7*0?0,") + number(hour.temperature, "99.9") + ",1.0,80,100000,0,0,300,0,0,0,0,0,0,0," +
         number(hour.windFrom, "999") + "," + number(hour.windSpeed, "999.0") +
         ",5,5,20.0,77777,9,999999999,0,0.05,0,88,0.2,0.0,1.0";
}

std::string tmy3Line(const WeatherHour& hour)
{
  char start[64];
  std::snprintf(start, sizeof start, "%02d/%02d/%d,%02d:00,0,", hour.month, hour.day, yearOfMonth(hour.month),
                hour.hour);
  return start + number(hour.temperature, "-9900") + ",A,7," + number(hour.windFrom, "-9900") + ",A,7," +
         number(hour.windSpeed, "-9900") + ",A,7";
}

} // namespace

std::vector<WeatherHour> yearOf(const HourMaker& make, bool isLeap)
{
  const std::array days{31, isLeap ? 29 : 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  std::vector<WeatherHour> hours;
  for (int month = 1; month <= 12; ++month)
  {
    for (int hour = 0; hour < 24 * days[static_cast<std::size_t>(month - 1)]; ++hour)
    {
      WeatherHour made;
      made.month = month;
      made.day = hour / 24 + 1;
      made.hour = hour % 24 + 1;
      make(made, static_cast<int>(hours.size()));
      hours.push_back(made);
    }
  }
  return hours;
}

std::vector<std::string> linesOf(const EpwSample& sample)
{
  std::vector<std::string> lines{sample.start + sample.location + number(sample.latitude, "") + ",4.77,1.0,10.0",
                                 "DESIGN CONDITIONS,0",
                                 "TYPICAL/EXTREME PERIODS,0",
                                 "GROUND TEMPERATURES,0",
                                 "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0",
                                 "COMMENTS 1,\"made, for tests\"",
                                 "COMMENTS 2,",
                                 sample.periods};
  for (const WeatherHour& record : sample.records)
  {
    lines.push_back(epwLine(record));
  }
  return lines;
}

std::string textOf(const std::vector<std::string>& lines, const std::string& lineEnd)
{
  std::string text;
  for (const std::string& line : lines)
  {
    text += line + lineEnd;
  }
  return text;
}

std::string textOf(const EpwSample& sample) { return textOf(linesOf(sample), sample.lineEnd); }

std::vector<std::string> tmy3LinesOf(const std::vector<WeatherHour>& hours, double latitude)
{
  std::vector<std::string> lines{
      "700000,\"CITY, HARBOR\",ST,1.0," + number(latitude, "") + ",4.77,10",
      "Date (MM/DD/YYYY),Time (HH:MM),ETR (W/m^2),Dry-bulb (C),Dry-bulb source,Dry-bulb uncert (code),Wdir "
      "(degrees),Wdir source,Wdir uncert (code),Wspd (m/s),Wspd source,Wspd uncert (code)"};
  for (const WeatherHour& hour : hours)
  {
    lines.push_back(tmy3Line(hour));
  }
  return lines;
}

} // namespace atria::testing
