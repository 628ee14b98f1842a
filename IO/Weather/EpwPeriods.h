// SPDX-License-Identifier: GPL-3.0-or-later
/// Reads the line DATA PERIODS of an EPW file: which hours the file must hold.
#pragma once

#include "HourSequence.h"
#include "WeatherText.h"

namespace atria::weather {

/// Returns the plan at the current line. Days are written as 7/14, 7/14/2010, 2010/7/14, 14 Jul, July 14, or as the day
/// of the year. Throws Error if the line does not describe as many periods as it says.
HourPlan planFrom(const LineReader& place);

} // namespace atria::weather
