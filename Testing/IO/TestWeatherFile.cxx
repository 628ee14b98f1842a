// SPDX-License-Identifier: GPL-3.0-or-later
#include "WeatherFile.h"
#include "WeatherHours.h"
#include "WeatherSamples.h"

#include "Support/Error.h"
#include "Support/TestPaths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

namespace {

using namespace atria::weather;
using namespace atria::testing;
using testing::HasSubstr;
using testing::StartsWith;

void steadyHour(WeatherHour& hour, int number)
{
  hour.temperature = 10.0 + number % 17;
  hour.windFrom = 10.0 * (number % 36);
  hour.windSpeed = 1.0 + 0.1 * (number % 53);
}

Weather weatherOf(const EpwSample& sample) { return weatherFrom(textOf(sample), "city.epw"); }
Weather weatherOf(const std::vector<std::string>& lines) { return weatherFrom(textOf(lines), "city.epw"); }

std::string refusalOf(const std::string& text)
{
  try
  {
    weatherFrom(text, "city.epw");
  }
  catch (const atria::Error& error)
  {
    return error.what();
  }
  return "was taken";
}

std::string refusalOf(const std::vector<std::string>& lines) { return refusalOf(textOf(lines)); }

/// Returns the refusal of the first lines alone.
std::string refusalOfFirst(std::ptrdiff_t count, const std::vector<std::string>& lines)
{
  return refusalOf(std::vector<std::string>(lines.begin(), lines.begin() + count));
}

/// Returns a year's lines with a field of one line replaced. Lines are counted from 1, fields from 0.
std::vector<std::string> withField(std::vector<std::string> lines, std::size_t line, int field, const std::string& text)
{
  std::string& changed = lines[line - 1];
  std::size_t start = 0;
  for (int i = 0; i < field; ++i)
  {
    start = changed.find(',', start) + 1;
  }
  changed.replace(start, changed.find(',', start) - start, text);
  return lines;
}

class WeatherFiles : public testing::Test
{
protected:
  const std::vector<WeatherHour> year = yearOf(steadyHour);
  const std::vector<std::string> epw = linesOf(EpwSample{year});
  const std::vector<std::string> tmy3 = tmy3LinesOf(year);
};

void expectSame(const std::vector<WeatherHour>& read, const std::vector<WeatherHour>& wanted)
{
  ASSERT_EQ(read.size(), wanted.size());
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    ASSERT_EQ(std::tie(read[i].month, read[i].day, read[i].hour),
              std::tie(wanted[i].month, wanted[i].day, wanted[i].hour));
    ASSERT_EQ(read[i].temperature, wanted[i].temperature);
    ASSERT_EQ(read[i].windFrom, wanted[i].windFrom);
    ASSERT_EQ(read[i].windSpeed.has_value(), wanted[i].windSpeed.has_value());
    ASSERT_NEAR(read[i].windSpeed.value_or(0.0), wanted[i].windSpeed.value_or(0.0), 1e-9);
  }
}

TEST_F(WeatherFiles, EpwGivesItsHoursAndItsPlace)
{
  const Weather weather = weatherOf(epw);
  EXPECT_EQ(weather.format, WeatherFormat::Epw);
  EXPECT_EQ(weather.station.name, "City, Region, LND");
  EXPECT_EQ(weather.station.latitude, 52.3);
  EXPECT_EQ(weather.station.longitude, 4.77);
  EXPECT_EQ(weather.station.elevation, 10.0);
  EXPECT_EQ(weather.hours.size(), 8760u);
  expectSame(weather.hours, year);
}

TEST_F(WeatherFiles, Tmy3GivesItsHoursAndItsPlace)
{
  const Weather weather = weatherOf(tmy3);
  EXPECT_EQ(weather.format, WeatherFormat::Tmy3);
  EXPECT_EQ(weather.station.name, "CITY, HARBOR, ST");
  EXPECT_EQ(weather.station.latitude, 52.3);
  expectSame(weather.hours, year);
}

TEST_F(WeatherFiles, LineEndsAndAByteOrderMarkChangeNothing)
{
  EpwSample sample{year};
  sample.lineEnd = "\r\n";
  sample.start = "\xEF\xBB\xBF";
  expectSame(weatherOf(sample).hours, year);
  expectSame(weatherFrom("\xEF\xBB\xBF" + textOf(tmy3, "\r\n"), "city.csv").hours, year);
}

TEST_F(WeatherFiles, ANameInLatin1BecomesUtf8)
{
  EpwSample sample{year};
  sample.location = "LOCATION,\"Z\xFCrich, Kloten\",-,CHE,Test,066700,";
  EXPECT_EQ(weatherOf(sample).station.name, "Zürich, Kloten, CHE");
}

TEST_F(WeatherFiles, ReadsFromDisk)
{
  const ScratchFolder folder;
  const auto file = folder.path() / "city.epw";
  std::ofstream(file, std::ios::binary) << textOf(epw);
  EXPECT_EQ(readWeather(file).hours.size(), 8760u);
  EXPECT_THROW(readWeather(folder.path() / "absent.epw"), atria::Error);
  EXPECT_THROW(readWeather(folder.path()), atria::Error);
}

TEST_F(WeatherFiles, OldFilesHave32Columns)
{
  std::vector<std::string> lines = epw;
  for (std::size_t i = 8; i < lines.size(); ++i)
  {
    lines[i].erase(lines[i].rfind(",0.2,"));
  }
  expectSame(weatherOf(lines).hours, year);
}

TEST(WeatherYears, LeapYearsHave8784Hours)
{
  const std::vector<WeatherHour> leapYear = yearOf(steadyHour, true);
  ASSERT_EQ(leapYear.size(), 8784u);
  expectSame(weatherOf(EpwSample{leapYear}).hours, leapYear);
  expectSame(weatherOf(tmy3LinesOf(leapYear)).hours, leapYear);
}

TEST_F(WeatherFiles, TheYearOfALeapDayIsALeapYear)
{
  constexpr std::size_t leapDay = 24 * (31 + 28); // hours before it
  const std::vector<WeatherHour> leapYear = yearOf(steadyHour, true);
  const auto refusedEpw = [&](const char* ofYear) {
    return refusalOf(withField(linesOf(EpwSample{leapYear}), 9 + leapDay, 0, ofYear));
  };
  EXPECT_EQ(refusedEpw("2021"),
            "city.epw:1425: 2/29 does not exist in 2021, which is no leap year: correct the year, or remove the day");
  EXPECT_THAT(refusedEpw("1900"), StartsWith("city.epw:1425: 2/29 does not exist in 1900"));
  for (const char* ofYear : {"2000", "2024", "0", ""})
  {
    EXPECT_EQ(refusedEpw(ofYear), "was taken") << ofYear;
  }
  EXPECT_THAT(refusalOf(withField(tmy3LinesOf(leapYear), 3 + leapDay, 0, "02/29/2021")),
              StartsWith("city.epw:1419: 2/29 does not exist in 2021"));
  EXPECT_EQ(refusalOf(withField(epw, 9 + leapDay - 1, 0, "2021")), "was taken") << "February 28th";
}

TEST_F(WeatherFiles, OnlyNinesAreMissing)
{
  for (const char* nines : {"99.9", "99.90", "+99.9", "99.99", "999", "999.0", "999.90", "9999"})
  {
    EXPECT_FALSE(weatherOf(withField(epw, 500, 6, nines)).hours[491].temperature) << nines;
  }
  for (const char* kelvin : {"295", "99.91", "100", "990", "-99.9", "1e3"})
  {
    EXPECT_THAT(refusalOf(withField(epw, 500, 6, kelvin)), StartsWith("city.epw:500: the dry-bulb temperature, "))
        << kelvin;
  }
  EXPECT_FALSE(weatherOf(withField(epw, 500, 21, "9999.0")).hours[491].windSpeed);
  EXPECT_THAT(refusalOf(withField(epw, 500, 21, "1200")), StartsWith("city.epw:500: the wind speed, 1200 m/s"));
  EXPECT_THAT(refusalOf(withField(epw, 500, 20, "1000")), StartsWith("city.epw:500: the wind direction, 1000"));
  EXPECT_FALSE(weatherOf(withField(tmy3, 500, 3, "-9900.0")).hours[497].temperature);
  EXPECT_FALSE(weatherOf(withField(tmy3, 500, 3, "-9999")).hours[497].temperature);
  EXPECT_THAT(refusalOf(withField(tmy3, 500, 3, "-12000")), HasSubstr(":500: the dry-bulb temperature, -12000 C"));
}

TEST(WeatherYears, MissingValuesAreAbsent)
{
  const std::vector<WeatherHour> year = yearOf([](WeatherHour& hour, int number) {
    steadyHour(hour, number);
    hour.temperature = number % 100 == 0 ? std::nullopt : hour.temperature;
    hour.windFrom = number % 73 == 1 ? std::nullopt : hour.windFrom;
    hour.windSpeed = number % 73 == 2 ? std::nullopt : hour.windSpeed;
  });
  for (const std::vector<std::string>& lines : {linesOf(EpwSample{year}), tmy3LinesOf(year)})
  {
    const Weather weather = weatherOf(lines);
    expectSame(weather.hours, year);
    const MissingHours missing = missingIn(weather.hours, 0.5);
    EXPECT_EQ(missing.temperature, 88u);
    EXPECT_EQ(missing.wind, 240u);
  }
  // An empty field is missing, too.
  std::vector<std::string> lines = withField(linesOf(EpwSample{year}), 12, 6, "");
  EXPECT_FALSE(weatherOf(lines).hours[3].temperature);
}

TEST(WeatherYears, SeveralRecordsOfAnHourAreAveraged)
{
  const std::vector<WeatherHour> year = yearOf([](WeatherHour& hour, int) { hour.windSpeed = 4.0; });
  EpwSample sample;
  for (const WeatherHour& hour : year)
  {
    for (const double quarter : {0.0, 1.0, 2.0, 3.0})
    {
      sample.records.push_back(hour);
      sample.records.back().temperature = quarter < 3.0 ? std::optional(10.0 + quarter) : std::nullopt;
      sample.records.back().windFrom = quarter < 2.0 ? 350.0 : 10.0;
    }
  }
  sample.periods = "DATA PERIODS,1,4,Data,Sunday,1/1,12/31";
  const Weather weather = weatherOf(sample);
  ASSERT_EQ(weather.hours.size(), 8760u);
  EXPECT_EQ(weather.hours[100].temperature, 11.0);
  EXPECT_EQ(weather.hours[100].windSpeed, 4.0);
  EXPECT_NEAR(std::remainder(*weather.hours[100].windFrom, 360.0), 0.0, 1e-9) << "north, not the mean of numbers";
  sample.periods = "DATA PERIODS,1,6,Data,Sunday,1/1,12/31";
  EXPECT_THAT(refusalOf(textOf(sample)),
              StartsWith("city.epw:13: hour 1 of 1/1 has 4 records; DATA PERIODS (line 8) says 6"));
}

TEST_F(WeatherFiles, PeriodsAreWrittenInSeveralWays)
{
  for (const char* days : {"1/1,12/31", "1/ 1,2015/12/31", "1,365", "1 Jan,December 31", "1/1/2010,12/31/2010"})
  {
    EpwSample sample{year};
    sample.periods = std::string("DATA PERIODS,1,1,Data,Sunday,") + days;
    EXPECT_EQ(weatherOf(sample).hours.size(), 8760u) << days;
  }
}

TEST_F(WeatherFiles, PartsOfAYearAndSeveralYearsAreRead)
{
  EpwSample sample;
  for (const WeatherHour& hour : year)
  {
    const bool isKept = hour.month == 2 || (hour.month == 7 && hour.day <= 10);
    sample.records.insert(sample.records.end(), isKept ? 1 : 0, hour);
  }
  sample.periods = "DATA PERIODS,2,1,Cold,Sunday,2/1,2/28,Warm,Monday,7/1,7/10";
  EXPECT_EQ(weatherOf(sample).hours.size(), 24u * 38);
  sample.records = year;
  sample.records.insert(sample.records.end(), year.begin(), year.end());
  for (const char* periods :
       {"DATA PERIODS,1,1,Data,Sunday,1/1,12/31", "DATA PERIODS,1,1,Data,Sunday,1/1/2010,12/31/2011"})
  {
    sample.periods = periods;
    EXPECT_EQ(weatherOf(sample).hours.size(), 17520u);
  }
}

TEST_F(WeatherFiles, MidnightMayBeTheNextDaysFirstMinute)
{
  std::vector<std::string> lines = tmy3;
  for (std::size_t i = 2; i < lines.size(); ++i)
  {
    if (lines[i].find(",24:00,") != std::string::npos)
    {
      const WeatherHour& next = year[(i - 1) % year.size()];
      char start[32];
      std::snprintf(start, sizeof start, "%02d/%02d/2001,00:00,", next.month, next.day);
      lines[i] = start + lines[i].substr(lines[i].find(",24:00,") + 7);
    }
  }
  expectSame(weatherOf(lines).hours, year);
}

TEST_F(WeatherFiles, WhatIsNoWeatherIsRefused)
{
  EXPECT_EQ(refusalOf(""), "city.epw is empty; get it again");
  EXPECT_EQ(refusalOf("\n\n"), "city.epw is empty; get it again");
  EXPECT_THAT(refusalOf("PK\x03\x04rest"), HasSubstr("unpack it"));
  EXPECT_THAT(refusalOf("from,frequency,scale,shape\n0,1,4,2\n"),
              StartsWith("city.epw:1: this is neither an EPW file"));
}

TEST_F(WeatherFiles, BadHeadersAreRefusedWithTheirLine)
{
  std::vector<std::string> lines = epw;
  lines.erase(lines.begin() + 3);
  EXPECT_THAT(refusalOf(lines), StartsWith("city.epw:4: the line GROUND TEMPERATURES of the header is not here"));
  EXPECT_THAT(refusalOfFirst(6, epw), StartsWith("city.epw:6: the file ends in its header, before COMMENTS 2"));
  EXPECT_THAT(refusalOfFirst(8, epw), StartsWith("city.epw:8: the file ends after its header"));
  EXPECT_THAT(refusalOf(withField(epw, 1, 6, "north")), StartsWith("city.epw:1: the latitude, 'north', is no number"));
  EXPECT_THAT(refusalOf(withField(epw, 1, 6, "91")), StartsWith("city.epw:1: the latitude, 91, is not from -90 to 90"));
  EXPECT_THAT(refusalOf("LOCATION,City"), StartsWith("city.epw:1: LOCATION has 1 entries instead of 9"));
  EXPECT_THAT(refusalOf(withField(epw, 8, 1, "2")),
              StartsWith("city.epw:8: DATA PERIODS says 2 periods and describes 1"));
  EXPECT_THAT(refusalOf(withField(epw, 8, 2, "x")), StartsWith("city.epw:8: the number of records per hour"));
  EXPECT_THAT(refusalOf(withField(epw, 8, 5, "13/1")), StartsWith("city.epw:8: DATA PERIODS: '13/1' is no day"));
}

TEST_F(WeatherFiles, PeriodsThatDoNotMatchAreRefused)
{
  EXPECT_THAT(refusalOf(withField(epw, 8, 5, "2/1")),
              StartsWith("city.epw:9: hour 1 of 1/1 stands where DATA PERIODS (line 8) has hour 1 of 2/1"));
  EXPECT_THAT(refusalOf(withField(epw, 8, 6, "6/30")),
              StartsWith("city.epw:4353: hour 1 of 7/1 stands where DATA PERIODS (line 8) has hour 1 of 1/1"));
  EXPECT_THAT(refusalOf(withField(epw, 8, 2, "2")), StartsWith("city.epw:10: hour 1 of 1/1 has 1 records"));
}

TEST_F(WeatherFiles, TruncatedFilesAreRefused)
{
  EXPECT_THAT(refusalOfFirst(108, epw),
              StartsWith("city.epw:108: the file ends with hour 4 of 1/5, and DATA PERIODS (line 8) goes on to 12/31"));
  EXPECT_THAT(refusalOfFirst(102, tmy3),
              StartsWith("city.epw:102: the file ends with hour 4 of 1/5, and TMY3's year goes on to 12/31"));
  std::string text = textOf(epw);
  text.resize(text.size() - 60); // in the middle of a line
  EXPECT_THAT(refusalOf(text), StartsWith("city.epw:8768: the line has "));
}

TEST_F(WeatherFiles, HoursOutOfOrderAreRefused)
{
  std::vector<std::string> lines = epw;
  std::swap(lines[19], lines[20]);
  EXPECT_THAT(refusalOf(lines), StartsWith("city.epw:20: hour 13 of 1/1 comes after hour 11 of 1/1"));
  lines = epw;
  lines.insert(lines.begin() + 20, lines[19]);
  EXPECT_THAT(refusalOf(lines), StartsWith("city.epw:21: hour 12 of 1/1 is there more than once"));
  lines = tmy3;
  lines.erase(lines.begin() + 50);
  EXPECT_THAT(refusalOf(lines), StartsWith("city.epw:51: hour 2 of 1/3 comes after hour 24 of 1/2"));
}

TEST_F(WeatherFiles, BadValuesAreRefusedWithTheirLine)
{
  const auto refused = [&](int field, const char* text) { return refusalOf(withField(epw, 500, field, text)); };
  EXPECT_THAT(
      refused(6, "warm"),
      StartsWith("city.epw:500: the dry-bulb temperature, 'warm', is no number; where it is not known, write 99.9"));
  EXPECT_THAT(refused(6, "70.1"), StartsWith("city.epw:500: the dry-bulb temperature, 70.1 C, is not from -70 to 70"));
  EXPECT_THAT(refused(6, "-71"), StartsWith("city.epw:500: the dry-bulb temperature, -71 C,"));
  EXPECT_THAT(refused(6, "nan"), StartsWith("city.epw:500: the dry-bulb temperature, 'nan', is no number"));
  EXPECT_THAT(
      refused(20, "361"),
      StartsWith(
          "city.epw:500: the wind direction, 361 degrees, is not from 0 to 360; where it is not known, write 999"));
  EXPECT_THAT(refused(20, "-1"), StartsWith("city.epw:500: the wind direction, -1 degrees,"));
  EXPECT_THAT(refused(21, "41"), StartsWith("city.epw:500: the wind speed, 41 m/s, is not from 0 to 40"));
  EXPECT_THAT(refused(21, "1,5"), StartsWith("city.epw:500: the line has 36 columns instead of 35"));
  EXPECT_THAT(refused(1, "13"), StartsWith("city.epw:500: the month, 13, is not from 1 to 12"));
  EXPECT_THAT(refused(2, "1.5"), StartsWith("city.epw:500: the day, 1.5, is no whole number"));
  EXPECT_THAT(refused(3, "0"), StartsWith("city.epw:500: the hour, 0, is not from 1 to 24"));
  EXPECT_THAT(refusalOf(withField(tmy3, 500, 3, "x")),
              HasSubstr(":500: the dry-bulb temperature, 'x', is no number; where it is not known, write -9900"));
  EXPECT_THAT(refusalOf(withField(tmy3, 500, 0, "1999-01-01")),
              HasSubstr(":500: the date '1999-01-01' is not as 12/31/1999"));
  EXPECT_THAT(refusalOf(withField(tmy3, 500, 1, "noon")), HasSubstr(":500: the time 'noon' is not as 13:00"));
}

TEST_F(WeatherFiles, DamagedFilesAreReadOrRefused)
{
  EpwSample sample{{year.begin(), year.begin() + 48}};
  sample.periods = "DATA PERIODS,1,1,Data,Sunday,1/1,1/2";
  std::mt19937 random(3);
  int refused = 0;
  constexpr int times = 3000;
  for (int i = 0; i < times; ++i)
  {
    std::string text = textOf(i % 2 == 0 ? linesOf(sample) : std::vector<std::string>(tmy3.begin(), tmy3.begin() + 50));
    for (int change = 0; change < 3; ++change)
    {
      const std::size_t at = random() % text.size();
      random() % 4 == 0 ? text.erase(at, random() % 90) : text.replace(at, 1, 1, static_cast<char>(random() % 256));
    }
    refused += refusalOf(text) == "was taken" ? 0 : 1; // another exception would fail the test
  }
  EXPECT_GT(refused, times / 2);
}

TEST_F(WeatherFiles, WrongColumnsAreRefused)
{
  std::vector<std::string> lines = epw;
  lines[499] = "1999,1,21,12,60,A7,1.0";
  EXPECT_THAT(refusalOf(lines), StartsWith("city.epw:500: the line has 7 columns instead of 35"));
  lines = tmy3;
  lines[499] = "01/21/1999,18:00,0";
  EXPECT_THAT(refusalOf(lines), StartsWith("city.epw:500: the line has 3 columns instead of 12"));
  EXPECT_THAT(refusalOf(withField(tmy3, 2, 6, "Wind")), StartsWith("city.epw:2: there is no column 'Wdir (degrees)'"));
}

} // namespace
