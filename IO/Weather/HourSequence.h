// SPDX-License-Identifier: GPL-3.0-or-later
/// Collects the records of a weather file into hours, and checks that these follow each other.
#pragma once

#include "WeatherFile.h"
#include "WeatherText.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace atria::weather {

struct Day
{
  int month = 1;
  int day = 1;
  bool operator==(const Day&) const = default;
};

/// Days in a month, February's 29th included.
int daysIn(int month);
/// Throws Error for February 29th of a year that has none. The year is a field of the current line; one that is no
/// whole number above 0 is not checked.
void checkLeapDay(const LineReader& place, std::string_view year, const Day& day);
/// True if one day comes after another. After February 28th the 29th or March 1st may come.
bool isNextDay(const Day& before, const Day& after);

/// Part of the year that a file covers, whole days.
struct DataPeriod
{
  Day first{1, 1};
  Day last{12, 31};
  int passes = 1; ///< times that `last` comes by: the years that a period of several years covers
};

/// The hours that a file must hold. After the last period the first may come again, as in files of several years.
struct HourPlan
{
  std::vector<DataPeriod> periods{1};
  int recordsPerHour = 1;
  std::string source; ///< the part of the file that says so, for messages
};

class HourSequence
{
public:
  explicit HourSequence(HourPlan planned);

  /// Adds the record at the current line. Throws Error if another hour was due.
  void add(const WeatherHour& record, const LineReader& place);
  /// Returns all hours. Throws Error if there are none, or if the last period is not complete.
  std::vector<WeatherHour> finish(const LineReader& place);

private:
  void checkNext(const WeatherHour& record, const LineReader& place) const;
  void completeHour();

  HourPlan plan;
  std::vector<WeatherHour> hours;
  std::vector<WeatherHour> records;  ///< the records of the hour at hand
  std::optional<WeatherHour> before; ///< the hour before; nothing where a period begins
  std::size_t period = 0;
  int passesLeft = 0;
};

} // namespace atria::weather
