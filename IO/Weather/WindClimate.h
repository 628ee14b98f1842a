// SPDX-License-Identifier: GPL-3.0-or-later
/// The wind rose of a list of hours: how often the wind comes from each sector, and how strong it is.
#pragma once

#include "WeatherFile.h"
#include "WeibullFit.h"

#include <cstddef>
#include <vector>

namespace atria::weather {

struct RoseOptions
{
  int sectors = 12;       ///< equal ones, the first around north
  double calmSpeed = 0.5; ///< m/s; the least that weather services report is 1 knot
};

/// Hours of wind that a sector needs for a shape of its own: its standard error is then a tenth, 0.78 / sqrt(hours).
inline constexpr std::size_t leastHoursForShape = 60;

struct RoseSector
{
  double from = 0.0;          ///< middle of the sector, degrees clockwise from north
  std::vector<double> speeds; ///< its hours without calm ones, m/s
  double frequency = 0.0;     ///< share of all hours, with its part of the calm ones; 0 to 1
  Weibull weibull;            ///< with its part of the calm hours
  bool hasOwnShape = false;   ///< else the shape is that of all sectors together
};

/// Frequencies sum to 1. Calm hours have no direction and are shared out in proportion to the hours of the sectors.
struct WindRose
{
  std::vector<RoseSector> sectors;
  Weibull whole;           ///< the distribution of all hours whose wind is known
  std::size_t hours = 0;   ///< whose wind is known, calm ones included
  std::size_t calms = 0;   ///< without wind, or with less than the calm speed
  std::size_t missing = 0; ///< whose wind is not known, left out
  double meanSpeed = 0.0;  ///< m/s, calm hours included
};

/// Returns the rose. A sector with fewer than `leastHoursForShape` hours takes the shape of the whole, and one without
/// hours its scale too. Throws Error if no hour has wind.
WindRose windRoseOf(const std::vector<WeatherHour>& hours, const RoseOptions& options);

/// Returns the share of hours with more than a speed, m/s, by the distributions of the sectors. Wind comfort is judged
/// by these.
double shareAbove(const WindRose& rose, double speed);
/// Returns the share that was measured, for comparison.
double measuredShareAbove(const WindRose& rose, double speed);

/// True if directions are rounded to 10 degrees and sectors of this number do not hold equally many of these, with one
/// in their middle. Such sectors seem to have more wind, or less, than they have. Sound numbers are 4, 12 and 36.
bool dividesRoundedDirections(const std::vector<WeatherHour>& hours, int sectors);

} // namespace atria::weather
