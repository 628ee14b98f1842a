// SPDX-License-Identifier: GPL-3.0-or-later
/// NREL's TMY3: a line on the station, a line with the names of columns, then a line for each hour.
#pragma once

#include "WeatherFile.h"
#include "WeatherText.h"

namespace atria::weather {

/// True if a file with this second line is TMY3.
bool isTmy3(std::string_view secondLine);

/// Returns what the file holds. The reader stands at the first line. Throws Error.
Weather readTmy3(LineReader& lines);

} // namespace atria::weather
