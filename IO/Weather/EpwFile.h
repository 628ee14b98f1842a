// SPDX-License-Identifier: GPL-3.0-or-later
/// EnergyPlus's EPW: eight lines of header, then a line for each record.
#pragma once

#include "WeatherFile.h"
#include "WeatherText.h"

namespace atria::weather {

/// True if a file with this first line is EPW.
bool isEpw(std::string_view firstLine);

/// Returns what the file holds. The reader stands at the first line. Throws Error.
Weather readEpw(LineReader& lines);

} // namespace atria::weather
