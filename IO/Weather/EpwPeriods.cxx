// SPDX-License-Identifier: GPL-3.0-or-later
#include "EpwPeriods.h"

#include "Support/Text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace atria::weather {

namespace {

struct Date
{
  Day day;
  std::optional<int> year;
};

/// Returns the parts between slashes and blanks.
std::vector<std::string_view> partsOf(std::string_view text)
{
  std::vector<std::string_view> parts;
  constexpr std::string_view between = "/ \t";
  for (std::size_t start = text.find_first_not_of(between); start != text.npos;)
  {
    const std::size_t end = text.find_first_of(between, start);
    parts.push_back(text.substr(start, end == text.npos ? end : end - start));
    start = end == text.npos ? end : text.find_first_not_of(between, end);
  }
  return parts;
}

/// Returns the number of a month by its English name or the first three letters; 0 if it is none.
int monthNamed(std::string_view word)
{
  constexpr std::array names{"jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec"};
  const std::string start = lowered(word.substr(0, 3));
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (start == names[i])
    {
      return static_cast<int>(i) + 1;
    }
  }
  return 0;
}

std::optional<int> wholeNumber(std::string_view word)
{
  const std::optional<double> value = numberFrom(word);
  const bool isWhole = value && *value == std::floor(*value) && std::abs(*value) < 1e6;
  return isWhole ? std::optional(static_cast<int>(*value)) : std::nullopt;
}

/// Returns the day of a year of 365 days; the 366th is the last one, too.
Day dayOfYear(int number)
{
  Day day;
  for (int i = 1; i < std::min(number, 365); ++i)
  {
    const int last = day.month == 2 ? 28 : daysIn(day.month);
    day = day.day < last ? Day{day.month, day.day + 1} : Day{day.month + 1, 1};
  }
  return day;
}

/// Returns the date of two parts, one of which may be the name of a month.
Date monthAndDay(std::string_view one, std::string_view other)
{
  if (const int month = monthNamed(one); month > 0)
  {
    return {{month, wholeNumber(other).value_or(0)}, {}};
  }
  if (const int month = monthNamed(other); month > 0)
  {
    return {{month, wholeNumber(one).value_or(0)}, {}};
  }
  return {{wholeNumber(one).value_or(0), wholeNumber(other).value_or(0)}, {}};
}

Date dateOf(const std::vector<std::string_view>& parts)
{
  if (parts.size() == 1)
  {
    const int number = wholeNumber(parts[0]).value_or(0);
    return {number >= 1 && number <= 366 ? dayOfYear(number) : Day{0, 0}, {}};
  }
  if (parts.size() == 3)
  {
    const bool yearFirst = wholeNumber(parts[0]).value_or(0) > 31;
    Date date = yearFirst ? monthAndDay(parts[1], parts[2]) : monthAndDay(parts[0], parts[1]);
    date.year = wholeNumber(parts[yearFirst ? 0 : 2]);
    return date;
  }
  return parts.size() == 2 ? monthAndDay(parts[0], parts[1]) : Date{{0, 0}, {}};
}

Date dateIn(const LineReader& place, std::string_view field)
{
  const Date date = dateOf(partsOf(field));
  const Day& day = date.day;
  if (day.month < 1 || day.month > 12 || day.day < 1 || day.day > daysIn(day.month))
  {
    place.fail("DATA PERIODS: '" + std::string(field) + "' is no day; write month/day, such as 12/31");
  }
  return date;
}

/// Returns how often the last day comes by until the period ends.
int passesOf(const Date& first, const Date& last)
{
  const bool wraps = std::pair(last.day.month, last.day.day) < std::pair(first.day.month, first.day.day);
  const int years = first.year && last.year ? *last.year - *first.year : 0;
  return std::max(1, wraps ? years : years + 1);
}

DataPeriod periodOf(const Date& first, const Date& last) { return {first.day, last.day, passesOf(first, last)}; }

} // namespace

HourPlan planFrom(const LineReader& place)
{
  const std::vector<std::string_view> fields = fieldsOf(place.line());
  if (fields.size() < 3)
  {
    place.fail(
        "DATA PERIODS has no number of periods and of records per hour; write DATA PERIODS,1,1,Data,Sunday,1/1,12/31");
  }
  constexpr int most = 1000;
  const int count = wholeNumberIn(place, fields[1], "number of DATA PERIODS", 1, most);
  HourPlan plan;
  plan.recordsPerHour = wholeNumberIn(place, fields[2], "number of records per hour of DATA PERIODS", 1, 60);
  plan.source = "DATA PERIODS (line " + std::to_string(place.number()) + ")";
  plan.periods.clear();
  const std::size_t described = (fields.size() - 3) / 4; // name, day of the week, first day, last day
  if (described < static_cast<std::size_t>(count))
  {
    place.fail("DATA PERIODS says " + std::to_string(count) + " periods and describes " + std::to_string(described) +
               "; each has a name, the day of the week, the first and the last day");
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
  {
    plan.periods.push_back(periodOf(dateIn(place, fields[5 + 4 * i]), dateIn(place, fields[6 + 4 * i])));
  }
  return plan;
}

} // namespace atria::weather
