// SPDX-License-Identifier: GPL-3.0-or-later
#include "ClimateTable.h"
#include "RosePicture.h"
#include "WeatherHours.h"
#include "WeatherSamples.h"
#include "WindClimate.h"

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

/// Goes through the numbers of a year's hours in an order that mixes all times of day and year.
int mixed(int number) { return number * 1009 % 8760; }

/// Returns a number in (0, 1), the same on all machines.
double uniform(std::mt19937& random) { return (static_cast<double>(random()) + 0.5) / 4294967296.0; }

double weibullSpeed(std::mt19937& random, const Weibull& weibull)
{
  return weibull.scale * std::pow(-std::log(uniform(random)), 1.0 / weibull.shape);
}

std::vector<double> weibullSpeeds(const Weibull& weibull, int count, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<double> speeds;
  for (int i = 0; i < count; ++i)
  {
    speeds.push_back(weibullSpeed(random, weibull));
  }
  return speeds;
}

/// Expects a fit within four standard errors of maximum likelihood for so many hours.
void expectNear(const Weibull& fitted, const Weibull& wanted, double hours)
{
  EXPECT_NEAR(fitted.shape, wanted.shape, 4.0 * 0.78 * wanted.shape / std::sqrt(hours));
  EXPECT_NEAR(fitted.scale, wanted.scale, 4.0 * 1.053 * wanted.scale / wanted.shape / std::sqrt(hours));
}

double frequencies(const WindRose& rose)
{
  double sum = 0.0;
  for (const RoseSector& sector : rose.sectors)
  {
    sum += sector.frequency;
  }
  return sum;
}

WeatherHour windyHour(double from, double speed)
{
  WeatherHour hour;
  hour.windFrom = from;
  hour.windSpeed = speed;
  return hour;
}

/// Returns a year whose distribution depends on the sector, with some calm and some missing hours.
std::vector<WeatherHour> windyYear()
{
  std::mt19937 random(7);
  return yearOf([&](WeatherHour& hour, int number) {
    const int sector = number % 12;
    hour.temperature = 5.0 + 20.0 * uniform(random);
    hour.windFrom = sector * 30 + 10.0 * (number / 12 % 3 - 1);
    hour.windFrom = *hour.windFrom < 0.0 ? 350.0 : *hour.windFrom;
    hour.windSpeed = std::round(10.0 * weibullSpeed(random, {3.0 + 0.3 * sector, 2.0})) / 10.0;
    if (number % 20 == 0)
    {
      hour.windFrom = hour.windSpeed = 0.0;
    }
    if (number % 50 == 1)
    {
      hour.windFrom.reset();
    }
  });
}

TEST(WeatherHours, CountsTheHoursOfARangeExactly)
{
  // 2,232 hours lie in [18, 26], the ends among them; the next ones outside are a hundredth away.
  const std::vector<WeatherHour> year = yearOf([](WeatherHour& hour, int number) {
    const int place = mixed(number);
    hour.temperature = place < 2232 ? 18.0 + 8.0 * place / 2231.0 : place % 2 == 0 ? 17.99 : 26.01;
  });
  const std::vector<WeatherHour> read = weatherFrom(textOf(EpwSample{year}), "city.epw").hours;
  const TemperatureCount count = countIn(read, TemperatureRange());
  EXPECT_EQ(count.inRange, 2232u);
  EXPECT_EQ(count.known, 8760u);
  HourFilter filter;
  filter.temperature = TemperatureRange();
  EXPECT_EQ(hoursKept(read, filter).size(), 2232u);
  EXPECT_EQ(hoursKept(read, {}).size(), 8760u);
}

TEST(WeatherHours, UnknownTemperaturesAreInNoRange)
{
  std::vector<WeatherHour> hours(4);
  hours[0].temperature = 20.0;
  hours[1].temperature = 10.0;
  EXPECT_EQ(countIn(hours, {}).known, 2u);
  EXPECT_DOUBLE_EQ(countIn(hours, {}).share(), 0.5);
  EXPECT_EQ(hoursKept(hours, {.temperature = TemperatureRange{-70.0, 70.0}}).size(), 2u);
}

TEST(WeatherHours, TimesOfDayWrapOverMidnight)
{
  const std::vector<WeatherHour> year = yearOf([](WeatherHour&, int) {});
  const auto hoursADay = [&](int from, int to) { return hoursKept(year, {.time = {from, to}}).size() / 365; };
  EXPECT_EQ(hoursADay(8, 18), 10u);
  EXPECT_EQ(hoursADay(22, 6), 8u);
  EXPECT_EQ(hoursADay(0, 24), 24u);
  EXPECT_EQ(hoursADay(23, 0), 1u);
  // The hour that ends at 9 lies between 8 and 9.
  EXPECT_EQ(hoursKept(year, {.time = {8, 9}}).front().hour, 9);
}

TEST(WeatherHours, SeasonsGoByTheHemisphere)
{
  EXPECT_EQ(monthsOf(Season::Spring, 52.0), monthsFrom("3-5"));
  EXPECT_EQ(monthsOf(Season::Summer, 52.0), monthsFrom("6-8"));
  EXPECT_EQ(monthsOf(Season::Autumn, 0.0), monthsFrom("9-11"));
  EXPECT_EQ(monthsOf(Season::Winter, 52.0), monthsFrom("12-2"));
  EXPECT_EQ(monthsOf(Season::Spring, -33.0), monthsFrom("9-11"));
  EXPECT_EQ(monthsOf(Season::Summer, -33.0), monthsFrom("12,1,2"));
  EXPECT_EQ(monthsOf(Season::Winter, -0.1), monthsFrom("6-8"));
}

TEST(WeatherHours, MonthsAreListsAndRanges)
{
  EXPECT_EQ(monthsFrom("7").to_ulong(), 1u << 6);
  EXPECT_EQ(monthsFrom("11-2").count(), 4u);
  EXPECT_EQ(monthsFrom("1, 6 - 8").count(), 4u);
  EXPECT_EQ(monthsFrom("4-3").count(), 12u);
  for (const char* wrong : {"", "0", "13", "4-", "-4", "april", "1.5", "1-2-3", "1,,2"})
  {
    EXPECT_THROW(monthsFrom(wrong), atria::Error) << wrong;
  }
}

TEST(WeibullFit, FindsTheParametersOfASample)
{
  for (const Weibull wanted : {Weibull{4.0, 2.0}, Weibull{6.5, 1.4}, Weibull{3.0, 3.2}})
  {
    for (const int hours : {60, 700, 8760})
    {
      expectNear(fitWeibull({weibullSpeeds(wanted, hours, 1)}), wanted, hours);
    }
  }
}

TEST(WeibullFit, FindsThemIfSlowHoursAreKnownOnlyToBeCalm)
{
  const Weibull wanted{3.0, 1.7};
  constexpr double limit = 1.5;
  SpeedSample sample;
  sample.calmLimit = limit;
  for (const double speed : weibullSpeeds(wanted, 8760, 2))
  {
    sample.calms += speed < limit ? 1.0 : 0.0;
    sample.speeds.insert(sample.speeds.end(), speed < limit ? 0 : 1, speed);
  }
  EXPECT_GT(sample.calms, 2000.0);
  const Weibull fitted = fitWeibull(sample);
  EXPECT_NEAR(fitted.shape, wanted.shape, 4.0 * 1.0 * wanted.shape / std::sqrt(8760.0)); // some of the sample is lost
  EXPECT_NEAR(fitted.scale, wanted.scale, 4.0 * 1.2 * wanted.scale / wanted.shape / std::sqrt(8760.0));
  sample.calms = 0.0;
  EXPECT_GT(fitWeibull(sample).shape, wanted.shape + 0.5) << "left out, they would bias it";
}

TEST(WeibullFit, UnitsOfSpeedDoNotMatter)
{
  SpeedSample sample{weibullSpeeds({4.0, 2.0}, 500, 3), 50.0, 0.1};
  const Weibull fitted = fitWeibull(sample);
  for (double& speed : sample.speeds)
  {
    speed *= 3.6;
  }
  sample.calmLimit *= 3.6;
  EXPECT_NEAR(fitWeibull(sample).scale, 3.6 * fitted.scale, 1e-9);
  EXPECT_NEAR(fitWeibull(sample).shape, fitted.shape, 1e-9);
}

TEST(WeibullFit, EqualSpeedsGiveTheGreatestShape)
{
  const Weibull fitted = fitWeibull({std::vector<double>(100, 5.1)});
  EXPECT_NEAR(fitted.shape, greatestShape, 1e-6);
  EXPECT_NEAR(fitted.scale, 5.1, 1e-6);
}

TEST(WeibullFit, AGivenShapeIsKept)
{
  const Weibull fitted = fitScale({weibullSpeeds({4.0, 2.0}, 2000, 4)}, 2.0);
  EXPECT_EQ(fitted.shape, 2.0);
  EXPECT_NEAR(fitted.scale, 4.0, 4.0 * 4.0 / 2.0 / std::sqrt(2000.0));
}

TEST(WindRose, SumsToOneAndCountsEveryHour)
{
  const std::vector<WeatherHour> year = windyYear();
  for (const int sectors : {4, 8, 12, 16, 36})
  {
    const WindRose rose = windRoseOf(year, {sectors, 0.5});
    EXPECT_EQ(rose.sectors.size(), static_cast<std::size_t>(sectors));
    EXPECT_NEAR(frequencies(rose), 1.0, 1e-12);
    EXPECT_EQ(rose.hours + rose.missing, 8760u);
    EXPECT_GT(rose.missing, 0u);
    std::size_t windy = 0;
    for (const RoseSector& sector : rose.sectors)
    {
      windy += sector.speeds.size();
    }
    EXPECT_EQ(windy + rose.calms, rose.hours);
    EXPECT_NEAR(shareAbove(rose, 5.0), measuredShareAbove(rose, 5.0), 0.01);
    EXPECT_NEAR(shareAbove(rose, 0.0), 1.0, 1e-12);
  }
}

TEST(WindRose, FindsTheDistributionOfEachSector)
{
  std::mt19937 random(11);
  std::vector<WeatherHour> hours;
  const std::vector<Weibull> wanted{{3.0, 1.5}, {5.0, 2.0}, {7.0, 2.5}, {4.0, 3.0}};
  for (int i = 0; i < 8000; ++i)
  {
    const auto sector = static_cast<std::size_t>(i % 4);
    hours.push_back(windyHour(90.0 * static_cast<double>(sector), weibullSpeed(random, wanted[sector])));
  }
  const WindRose rose = windRoseOf(hours, {4, 0.0});
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_DOUBLE_EQ(rose.sectors[i].frequency, 0.25);
    EXPECT_TRUE(rose.sectors[i].hasOwnShape);
    expectNear(rose.sectors[i].weibull, wanted[i], 2000.0);
  }
}

TEST(WindRose, TheFirstSectorLiesAroundNorth)
{
  const std::vector<WeatherHour> hours{windyHour(0.0, 3.0),  windyHour(360.0, 3.0), windyHour(345.0, 3.0),
                                       windyHour(14.9, 3.0), windyHour(15.0, 3.0),  windyHour(344.9, 3.0),
                                       windyHour(180.0, 3.0)};
  const WindRose rose = windRoseOf(hours, {});
  EXPECT_EQ(rose.sectors[0].speeds.size(), 4u);
  EXPECT_EQ(rose.sectors[1].speeds.size(), 1u);
  EXPECT_EQ(rose.sectors[6].speeds.size(), 1u);
  EXPECT_EQ(rose.sectors[11].speeds.size(), 1u);
  EXPECT_EQ(rose.sectors[6].from, 180.0);
}

TEST(WindRose, CalmHoursAreSharedOutInProportion)
{
  std::vector<WeatherHour> hours(30, windyHour(0.0, 0.0)); // direction 0 with speed 0 is no wind from north
  hours.resize(40);
  hours.back().windSpeed = 0.2; // the others have no wind at all
  hours.insert(hours.end(), 90, windyHour(90.0, 4.0));
  hours.insert(hours.end(), 10, windyHour(180.0, 2.0));
  const WindRose rose = windRoseOf(hours, {4, 0.5});
  EXPECT_EQ(rose.calms, 31u);
  EXPECT_EQ(rose.missing, 9u);
  EXPECT_EQ(rose.hours, 131u);
  EXPECT_DOUBLE_EQ(rose.sectors[0].frequency, 0.0);
  EXPECT_DOUBLE_EQ(rose.sectors[1].frequency, 0.9);
  EXPECT_DOUBLE_EQ(rose.sectors[2].frequency, 0.1);
  EXPECT_NEAR(rose.meanSpeed, (0.2 + 360.0 + 20.0) / 131.0, 1e-12);
  EXPECT_EQ(windRoseOf(hours, {4, 0.0}).calms, 30u) << "without a threshold only hours without wind are calm";
}

TEST(WindRose, SectorsWithFewHoursTakeTheShapeOfTheWhole)
{
  std::vector<WeatherHour> hours;
  for (const double speed : weibullSpeeds({4.0, 2.0}, 1000, 5))
  {
    hours.push_back(windyHour(0.0, speed));
  }
  for (std::size_t i = 1; i <= leastHoursForShape; ++i)
  {
    hours.push_back(windyHour(90.0, 2.0 + 0.01 * static_cast<double>(i)));
    hours.insert(hours.end(), i < leastHoursForShape ? 1 : 0, windyHour(180.0, 2.0));
  }
  const WindRose rose = windRoseOf(hours, {4, 0.5});
  EXPECT_TRUE(rose.sectors[1].hasOwnShape);
  EXPECT_FALSE(rose.sectors[2].hasOwnShape);
  EXPECT_EQ(rose.sectors[2].weibull.shape, rose.whole.shape);
  EXPECT_LT(rose.sectors[2].weibull.scale, rose.whole.scale);
  EXPECT_FALSE(rose.sectors[3].hasOwnShape) << "without hours it has both of the whole, and a frequency of 0";
  EXPECT_EQ(rose.sectors[3].weibull.scale, rose.whole.scale);
  EXPECT_EQ(rose.sectors[3].frequency, 0.0);
}

TEST(WindRose, NeedsWind)
{
  EXPECT_THROW(windRoseOf({}, {}), atria::Error);
  EXPECT_THROW(windRoseOf(std::vector<WeatherHour>(10, windyHour(0.0, 0.0)), {}), atria::Error);
  EXPECT_THROW(windRoseOf(std::vector<WeatherHour>(10), {}), atria::Error);
}

TEST(WindRose, EpwAndTmy3OfAYearGiveTheSame)
{
  const std::vector<WeatherHour> year = windyYear();
  const auto table = [](const std::string& text) {
    return csvOf(tableOf(windRoseOf(weatherFrom(text, "city").hours, {})));
  };
  EXPECT_EQ(table(textOf(EpwSample{year})), table(textOf(tmy3LinesOf(year))));
}

TEST(WindRose, RoundedDirectionsSuitSomeSectorsOnly)
{
  const std::vector<WeatherHour> rounded = windyYear();
  for (const int sound : {4, 12, 36})
  {
    EXPECT_FALSE(dividesRoundedDirections(rounded, sound)) << sound;
  }
  for (const int uneven : {8, 16, 18, 72})
  {
    EXPECT_TRUE(dividesRoundedDirections(rounded, uneven)) << uneven;
  }
  std::vector<WeatherHour> exact = rounded;
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    exact[i].windFrom = 0.041 * static_cast<double>(i);
  }
  EXPECT_FALSE(dividesRoundedDirections(exact, 16));
}

class ClimateTables : public testing::Test
{
protected:
  std::vector<ClimateSector> tableFrom(const std::string& text, const char* name = "climate.csv")
  {
    const auto file = folder.path() / name;
    std::ofstream(file, std::ios::binary) << text;
    return readClimateTable(file);
  }
  std::string refusalOf(const std::string& text, const char* name = "climate.csv")
  {
    try
    {
      tableFrom(text, name);
    }
    catch (const atria::Error& error)
    {
      return error.what();
    }
    return "was taken";
  }
  const ScratchFolder folder;
};

TEST_F(ClimateTables, AreReadAsTheyWereWritten)
{
  const std::vector<ClimateSector> written = tableOf(windRoseOf(windyYear(), {}));
  const std::vector<ClimateSector> read = tableFrom(csvOf(written));
  ASSERT_EQ(read.size(), 12u);
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    EXPECT_EQ(read[i].from, written[i].from);
    EXPECT_NEAR(read[i].frequency, written[i].frequency, 1e-6);
    EXPECT_NEAR(read[i].scale, written[i].scale, 1e-4);
    EXPECT_NEAR(read[i].shape, written[i].shape, 1e-4);
  }
}

TEST_F(ClimateTables, MayBeJsonAndInPercent)
{
  const auto csv = tableFrom("shape, from, scale, frequency\r\n2, -90, 4, 60\r\n1.8, 0, 5, 40\r\n");
  const auto json = tableFrom(R"([{"from": 270, "frequency": 0.6, "scale": 4, "shape": 2, "hours": 3},
                                  {"from": 0, "frequency": 0.4, "scale": 5, "shape": 1.8}])",
                              "climate.json");
  EXPECT_EQ(csvOf(csv), csvOf(json));
  EXPECT_EQ(csv[0].from, 270.0);
}

TEST_F(ClimateTables, DirectionsWithoutWindAreLeftOut)
{
  const auto table = tableFrom("from,frequency,scale,shape\n90,0.5,4,2\n30,0,4,2\n0,0.5,4,2\n");
  EXPECT_EQ(directionsOf(table), (std::vector<double>{90.0, 0.0}));
}

TEST_F(ClimateTables, BadOnesAreRefused)
{
  const std::string head = "from,frequency,scale,shape\n";
  EXPECT_THAT(refusalOf(head), HasSubstr("climate.csv: holds no sectors"));
  EXPECT_THAT(refusalOf(""), HasSubstr("holds no sectors"));
  EXPECT_THAT(refusalOf(head + "0,1,4\n"), HasSubstr("climate.csv, sector 1: 'shape' is missing"));
  EXPECT_THAT(refusalOf(head + "0,1,4,2\n0,x,4,2\n"), HasSubstr("sector 2: 'frequency' is missing or no number"));
  EXPECT_THAT(refusalOf(head + "0,0.5,4,2\n"), HasSubstr("sum up to 0.5 instead of 1 or 100"));
  EXPECT_THAT(refusalOf(head + "0,1,0,2\n"), HasSubstr("more than 0"));
  EXPECT_THAT(refusalOf(head + "0,0.5,4,2\n90,0.3,4,2\n-270.02,0.2,5,2\n"),
              HasSubstr("climate.csv, sector 3: sector 2 has the direction 90, too; give each direction once"));
  EXPECT_THAT(refusalOf(head + "359.98,0.5,4,2\n0,0.5,4,2\n"),
              HasSubstr("sector 2: sector 1 has the direction 0, too"));
  EXPECT_EQ(refusalOf(head + "10,0.5,4,2\n10.1,0.5,4,2\n"), "was taken");
  const std::vector<WeatherHour> year = yearOf([](WeatherHour& hour, int) { hour.temperature = 20.0; });
  for (const std::vector<std::string>& lines : {linesOf(EpwSample{year}), tmy3LinesOf(year)})
  {
    EXPECT_THAT(refusalOf(textOf(lines)), HasSubstr("climate.csv is a weather file and no table of the wind: make the "
                                                    "table of it first, by `atria climate`"));
  }
  EXPECT_THAT(refusalOf("{", "climate.json"), HasSubstr("no list of sectors in JSON"));
  EXPECT_THAT(refusalOf("[1]", "climate.json"), HasSubstr("sector 1: 'from' is missing"));
}

TEST(RosePicture, HasAPetalForEverySectorWithWindAndItsTexts)
{
  std::vector<WeatherHour> hours(100, windyHour(0.0, 3.0));
  hours.insert(hours.end(), 50, windyHour(90.0, 12.0));
  hours.insert(hours.end(), 50, windyHour(90.0, 1.0));
  hours.insert(hours.end(), 50, windyHour(0.0, 0.0));
  const std::string picture = rosePicture(windRoseOf(hours, {}), {"A & B <city>", "250 hours"});
  EXPECT_THAT(picture, testing::StartsWith("<svg xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_THAT(picture, HasSubstr("A &amp; B &lt;city&gt;"));
  EXPECT_THAT(picture, HasSubstr(">20.0 %<")) << "calm";
  std::size_t petals = 0;
  for (std::size_t at = picture.find("Z\" fill="); at != picture.npos; at = picture.find("Z\" fill=", at + 1))
  {
    ++petals;
  }
  EXPECT_EQ(petals, 3u);
}

} // namespace
