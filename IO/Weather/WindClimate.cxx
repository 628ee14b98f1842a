// SPDX-License-Identifier: GPL-3.0-or-later
#include "WindClimate.h"

#include "Support/Error.h"
#include "WeatherHours.h"
#include "WeatherText.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atria::weather {

namespace {

std::size_t sectorOf(double from, int sectors)
{
  const double width = 360.0 / sectors;
  const auto sector = static_cast<std::size_t>(std::floor(from / width + 0.5));
  return sector % static_cast<std::size_t>(sectors);
}

std::vector<RoseSector> emptySectors(int count)
{
  std::vector<RoseSector> sectors(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < sectors.size(); ++i)
  {
    sectors[i].from = 360.0 * static_cast<double>(i) / count;
  }
  return sectors;
}

/// Returns all winds without their directions. Calm hours have less than the least speed that was reported.
SpeedSample sampleOf(const WindRose& rose)
{
  SpeedSample sample;
  sample.calmLimit = std::numeric_limits<double>::max();
  for (const RoseSector& sector : rose.sectors)
  {
    for (const double speed : sector.speeds)
    {
      sample.speeds.push_back(speed);
      sample.calmLimit = std::min(sample.calmLimit, speed);
    }
  }
  sample.calms = static_cast<double>(rose.calms);
  return sample;
}

/// Sets the frequency and the distribution of a sector.
void fit(RoseSector& sector, const SpeedSample& all, const Weibull& whole)
{
  sector.frequency = static_cast<double>(sector.speeds.size()) / static_cast<double>(all.speeds.size());
  sector.weibull = whole;
  if (!sector.speeds.empty())
  {
    const SpeedSample sample{sector.speeds, all.calms * sector.frequency, all.calmLimit};
    sector.hasOwnShape = sector.speeds.size() >= leastHoursForShape;
    sector.weibull = sector.hasOwnShape ? fitWeibull(sample) : fitScale(sample, whole.shape);
  }
}

} // namespace

WindRose windRoseOf(const std::vector<WeatherHour>& hours, const RoseOptions& options)
{
  WindRose rose;
  rose.sectors = emptySectors(options.sectors);
  double sum = 0.0;
  for (const WeatherHour& hour : hours)
  {
    if (!hasWind(hour, options.calmSpeed))
    {
      ++rose.missing;
      continue;
    }
    ++rose.hours;
    sum += *hour.windSpeed;
    if (isCalm(*hour.windSpeed, options.calmSpeed))
    {
      ++rose.calms;
    }
    else
    {
      rose.sectors[sectorOf(*hour.windFrom, options.sectors)].speeds.push_back(*hour.windSpeed);
    }
  }
  if (rose.hours == rose.calms)
  {
    throw Error("none of " + std::to_string(hours.size()) + " hours has a known wind of " +
                shortNumber(options.calmSpeed) +
                " m/s or more; keep more hours, or take a file with the wind's speed "
                "and direction");
  }
  rose.meanSpeed = sum / static_cast<double>(rose.hours);
  const SpeedSample all = sampleOf(rose);
  rose.whole = fitWeibull(all);
  for (RoseSector& sector : rose.sectors)
  {
    fit(sector, all, rose.whole);
  }
  return rose;
}

double shareAbove(const WindRose& rose, double speed)
{
  double share = 0.0;
  for (const RoseSector& sector : rose.sectors)
  {
    share += sector.frequency * std::exp(-std::pow(speed / sector.weibull.scale, sector.weibull.shape));
  }
  return share;
}

double measuredShareAbove(const WindRose& rose, double speed)
{
  std::size_t count = 0;
  for (const RoseSector& sector : rose.sectors)
  {
    count += static_cast<std::size_t>(
        std::count_if(sector.speeds.begin(), sector.speeds.end(), [&](double each) { return each > speed; }));
  }
  return static_cast<double>(count) / static_cast<double>(rose.hours);
}

bool dividesRoundedDirections(const std::vector<WeatherHour>& hours, int sectors)
{
  constexpr int roundedDirections = 36;
  constexpr double mostlyRounded = 0.9;
  std::size_t known = 0, rounded = 0;
  for (const WeatherHour& hour : hours)
  {
    known += hour.windFrom ? 1 : 0;
    rounded += hour.windFrom && std::fmod(*hour.windFrom, 10.0) == 0.0 ? 1 : 0;
  }
  const bool isEven = roundedDirections % sectors == 0 && (roundedDirections / sectors) % 2 == 1;
  return !isEven && static_cast<double>(rounded) > mostlyRounded * static_cast<double>(known);
}

} // namespace atria::weather
