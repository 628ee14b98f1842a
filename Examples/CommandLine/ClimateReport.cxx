// SPDX-License-Identifier: GPL-3.0-or-later
#include "ClimateReport.h"

#include "Console.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

namespace atria::tool {

namespace {

using weather::RoseSector;
using weather::withCommas;

/// NEN 8100 judges comfort by the hours above this speed, m/s.
constexpr double comfortSpeed = 5.0;

std::string numberText(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

const char* formatName(const weather::Weather& weather)
{
  return weather.format == weather::WeatherFormat::Epw ? "EPW" : "TMY3";
}

std::string coordinate(double degrees, const char* positive, const char* negative)
{
  return numberText(std::abs(degrees)) + " " + (degrees < 0.0 ? negative : positive);
}

double percentOf(std::size_t part, std::size_t all)
{
  return all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 0.0;
}

double meanOf(const RoseSector& sector)
{
  const double sum = std::accumulate(sector.speeds.begin(), sector.speeds.end(), 0.0);
  return sector.speeds.empty() ? 0.0 : sum / static_cast<double>(sector.speeds.size());
}

Json jsonOf(const RoseSector& sector)
{
  return {{"from", sector.from},           {"frequency", sector.frequency},   {"scale", sector.weibull.scale},
          {"shape", sector.weibull.shape}, {"own_shape", sector.hasOwnShape}, {"hours", sector.speeds.size()},
          {"mean_speed", meanOf(sector)}};
}

void printRose(const weather::WindRose& rose)
{
  std::printf("\n%6s %7s %11s %11s %7s\n", "from", "hours", "frequency %", "scale (m/s)", "shape");
  for (const RoseSector& sector : rose.sectors)
  {
    std::printf("%6g %7s %11.1f %11.2f %7.2f\n", sector.from, withCommas(sector.speeds.size()).c_str(),
                100.0 * sector.frequency, sector.weibull.scale, sector.weibull.shape);
  }
  std::printf("%6s %7s %11.1f %11.2f %7.2f\n", "all", withCommas(rose.hours - rose.calms).c_str(), 100.0,
              rose.whole.scale, rose.whole.shape);
  std::printf("Above %g m/s: %.1f %% of hours in the file, %.1f %% by the table\n", comfortSpeed,
              100.0 * weather::measuredShareAbove(rose, comfortSpeed), 100.0 * weather::shareAbove(rose, comfortSpeed));
}

} // namespace

std::string titleOf(const Climate& climate) { return climate.weather.station.name; }

std::string subtitleOf(const Climate& climate)
{
  return withCommas(climate.kept) + " of " + withCommas(climate.weather.hours.size()) + " hours" +
         (climate.filter.empty() ? "" : ": " + climate.filter);
}

Json jsonOf(const Climate& climate)
{
  const weather::Station& station = climate.weather.station;
  const weather::WindRose& rose = climate.rose;
  Json report;
  report["file"] = climate.file;
  report["format"] = formatName(climate.weather);
  report["location"] = {{"name", station.name},
                        {"latitude", station.latitude},
                        {"longitude", station.longitude},
                        {"elevation", station.elevation}};
  report["hours"] = {{"read", climate.weather.hours.size()}, {"kept", climate.kept}, {"filter", climate.filter}};
  report["missing"] = {{"temperature", climate.missing.temperature}, {"wind", climate.missing.wind}};
  report["ventilation"] = {{"temperature", {climate.ventilation.least, climate.ventilation.most}},
                           {"hours", climate.ventilated.inRange},
                           {"of", climate.ventilated.known},
                           {"share", climate.ventilated.share()}};
  report["wind"] = {{"hours", rose.hours},       {"mean_speed", rose.meanSpeed},
                    {"calms", rose.calms},       {"calm_speed", climate.options.calmSpeed},
                    {"scale", rose.whole.scale}, {"shape", rose.whole.shape}};
  report["wind"]["above_5"] = {{"measured", weather::measuredShareAbove(rose, comfortSpeed)},
                               {"by_table", weather::shareAbove(rose, comfortSpeed)}};
  report["sectors"] = Json::array();
  for (const RoseSector& sector : rose.sectors)
  {
    report["sectors"].push_back(jsonOf(sector));
  }
  return report;
}

void printClimate(const Climate& climate)
{
  const weather::Station& station = climate.weather.station;
  const weather::TemperatureCount& ventilated = climate.ventilated;
  const weather::WindRose& rose = climate.rose;
  std::printf("%s: %s, %s, %s, %s m\n", station.name.c_str(), formatName(climate.weather),
              coordinate(station.latitude, "N", "S").c_str(), coordinate(station.longitude, "E", "W").c_str(),
              numberText(station.elevation).c_str());
  std::printf("Hours: %s read, %s kept%s%s\n", withCommas(climate.weather.hours.size()).c_str(),
              withCommas(climate.kept).c_str(), climate.filter.empty() ? "" : ": ", climate.filter.c_str());
  std::printf("Natural ventilation is possible by temperature (%g to %g °C): %s of %s hours, %.1f %%\n",
              climate.ventilation.least, climate.ventilation.most, withCommas(ventilated.inRange).c_str(),
              withCommas(ventilated.known).c_str(), 100.0 * ventilated.share());
  std::printf(
      "Wind: mean %.2f m/s; %s calm hours (below %g m/s, %.1f %%), shared out among the sectors in proportion\n",
      rose.meanSpeed, withCommas(rose.calms).c_str(), climate.options.calmSpeed, percentOf(rose.calms, rose.hours));
  printRose(rose);
}

void noteDoubts(const Climate& climate, Console& console)
{
  for (const Warning& doubt : weather::doubtsOf(climate))
  {
    const std::string text = climate.file + ": " + doubt.text;
    doubt.gravity == Gravity::grave ? console.warning(text) : console.note(text);
  }
}

} // namespace atria::tool
