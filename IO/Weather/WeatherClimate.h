// SPDX-License-Identifier: GPL-3.0-or-later
/// The climate of a weather file: the hours selected, how many suit natural ventilation, and their wind rose.
#pragma once

#include "Support/Warning.h"
#include "WeatherFile.h"
#include "WeatherHours.h"
#include "WindClimate.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace atria::weather {

/// The hours to keep, and the rose to make of them. A season and months exclude each other.
struct ClimateOptions
{
  TemperatureRange ventilation = {}; ///< temperatures that allow natural ventilation
  bool onlyVentilated = false;       ///< keep hours with these temperatures; else all hours, unknown ones too
  HoursOfDay time = {};
  std::optional<Season> season = std::nullopt;
  std::optional<Months> months = std::nullopt;
  RoseOptions rose = {};
};

/// A weather file's statistics.
struct Climate
{
  Weather weather;
  RoseOptions options;
  MissingHours missing;          ///< in the whole file
  std::size_t kept = 0;          ///< hours that the rose is made of
  TemperatureRange ventilation;  ///< temperatures that allow natural ventilation
  TemperatureCount ventilated;   ///< among hours that are kept but for their temperatures
  WindRose rose;                 ///< over the hours kept
  bool hasUnevenSectors = false; ///< see dividesRoundedDirections()
};

/// Throws Error if the options contradict themselves, such as a range whose upper end comes first.
void checkOptions(const ClimateOptions& options);

/// Returns the climate of a weather that was read. Throws Error if no hour is kept, naming the cause, or if none that
/// is kept has wind.
Climate climateOf(Weather weather, const ClimateOptions& options);

/// Reads a weather file and returns its climate. Errors name the file.
Climate readClimate(const std::filesystem::path& file, const ClimateOptions& options);

/// Returns what users should know of a climate: missing values, sectors with few hours, and sectors that do not suit
/// rounded directions. The grave ones put the rose in doubt.
std::vector<Warning> doubtsOf(const Climate& climate);

/// Returns an integer with commas between thousands, as messages have it.
std::string withCommas(std::size_t number);

} // namespace atria::weather
