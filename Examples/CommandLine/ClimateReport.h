// SPDX-License-Identifier: GPL-3.0-or-later
/// Describes the climate that `atria climate` found: as text, as JSON, and in notes.
#pragma once

#include "Report.h"

#include <WeatherFile.h>
#include <WeatherHours.h>
#include <WindClimate.h>

#include <string>

namespace atria::tool {

class Console;

/// A weather file's statistics, and what they were made with.
struct Climate
{
  std::string file;
  weather::Weather weather;
  weather::RoseOptions options;
  weather::MissingHours missing;         ///< in the whole file
  std::string filter;                    ///< words on the hours that were kept; empty for all
  std::size_t kept = 0;                  ///< hours that passed the filter
  weather::TemperatureRange ventilation; ///< temperatures that allow natural ventilation
  weather::TemperatureCount ventilated;  ///< among hours that pass the filter but for its temperatures
  weather::WindRose rose;                ///< made of the hours kept
  bool hasUnevenSectors = false;         ///< see weather::dividesRoundedDirections()
};

/// Returns the title of a picture and the line below it.
std::string titleOf(const Climate& climate);
std::string subtitleOf(const Climate& climate);

Json jsonOf(const Climate& climate);
void printClimate(const Climate& climate);

/// Reports missing values, sectors with few hours, and sectors that do not suit rounded directions.
void noteDoubts(const Climate& climate, Console& console);

} // namespace atria::tool
