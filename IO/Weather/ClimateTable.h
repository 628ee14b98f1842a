// SPDX-License-Identifier: GPL-3.0-or-later
/// Tables of the wind's climate, sector by sector, as `atria report` and `atria case` take them.
#pragma once

#include "WindClimate.h"

#include <filesystem>
#include <string>
#include <vector>

namespace atria::weather {

struct ClimateSector
{
  double from = 0.0;      ///< degrees clockwise from north, 0 to 360
  double frequency = 0.0; ///< share of hours, 0 to 1
  double scale = 0.0;     ///< m/s
  double shape = 0.0;
};

std::vector<ClimateSector> tableOf(const WindRose& rose);

/// Returns a table with the columns from, frequency, scale and shape.
std::string csvOf(const std::vector<ClimateSector>& table);

/// Reads a .csv table with these columns, or a .json list of objects with these keys. Frequencies may be shares or
/// percent; those returned sum to 1. Throws Error naming file and sector, also for a direction that stands twice, and
/// for a weather file in place of a table.
std::vector<ClimateSector> readClimateTable(const std::filesystem::path& file);

/// Returns where the wind comes from in sectors with a frequency above 0, in the order of the table.
std::vector<double> directionsOf(const std::vector<ClimateSector>& table);

} // namespace atria::weather
