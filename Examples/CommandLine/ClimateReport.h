// SPDX-License-Identifier: GPL-3.0-or-later
/// Describes the climate that `atria climate` found: as text, as JSON, and in notes.
#pragma once

#include "Report.h"

#include <WeatherClimate.h>

#include <string>

namespace atria::tool {

class Console;

/// A weather file's statistics, and words on what they were made of.
struct Climate : weather::Climate
{
  std::string file;
  std::string filter; ///< words on the hours that were kept; empty for all
};

/// Returns the title of a picture and the line below it.
std::string titleOf(const Climate& climate);
std::string subtitleOf(const Climate& climate);

Json jsonOf(const Climate& climate);
void printClimate(const Climate& climate);

/// Reports missing values, sectors with few hours, and sectors that do not suit rounded directions.
void noteDoubts(const Climate& climate, Console& console);

} // namespace atria::tool
