// SPDX-License-Identifier: GPL-3.0-or-later
/// Weather files for tests, made of hours that are known.
#pragma once

#include "WeatherFile.h"

#include <functional>
#include <string>
#include <vector>

namespace atria::testing {

using weather::WeatherHour;

/// Sets the values of an hour by its number, from 0.
using HourMaker = std::function<void(WeatherHour& hour, int number)>;

/// Returns all hours of a year.
std::vector<WeatherHour> yearOf(const HourMaker& make, bool isLeap = false);

/// An EPW file in parts, so that tests can spoil them.
struct EpwSample
{
  std::vector<WeatherHour> records;
  double latitude = 52.3;
  std::string location = "LOCATION,City,Region,LND,Test,000000,";
  std::string periods = "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31";
  std::string lineEnd = "\n";
  std::string start = {}; ///< ahead of everything, such as a byte order mark
};
/// Returns the lines of the file; the first record is the ninth.
std::vector<std::string> linesOf(const EpwSample& sample);
std::string textOf(const std::vector<std::string>& lines, const std::string& lineEnd = "\n");
std::string textOf(const EpwSample& sample);

/// Returns the lines of a TMY3 file; the first hour is the third.
std::vector<std::string> tmy3LinesOf(const std::vector<WeatherHour>& hours, double latitude = 52.3);

} // namespace atria::testing
