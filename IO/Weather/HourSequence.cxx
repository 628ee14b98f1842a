// SPDX-License-Identifier: GPL-3.0-or-later
#include "HourSequence.h"

#include "Support/Error.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace atria::weather {

namespace {

using Member = std::optional<double> WeatherHour::*;

bool isSameHour(const WeatherHour& a, const WeatherHour& b)
{
  return a.month == b.month && a.day == b.day && a.hour == b.hour;
}

bool isNextHour(const WeatherHour& before, const WeatherHour& after)
{
  const Day dayBefore{before.month, before.day};
  const Day dayAfter{after.month, after.day};
  return before.hour < 24 ? dayAfter == dayBefore && after.hour == before.hour + 1
                          : after.hour == 1 && isNextDay(dayBefore, dayAfter);
}

std::string nameOf(const WeatherHour& hour)
{
  return "hour " + std::to_string(hour.hour) + " of " + std::to_string(hour.month) + "/" + std::to_string(hour.day);
}

std::optional<double> meanOf(const std::vector<WeatherHour>& records, Member member)
{
  double sum = 0.0;
  int count = 0;
  for (const WeatherHour& record : records)
  {
    sum += (record.*member).value_or(0.0);
    count += (record.*member).has_value() ? 1 : 0;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// Returns the direction of the mean of the winds as vectors; nothing if they cancel out or none is known.
std::optional<double> meanDirection(const std::vector<WeatherHour>& records)
{
  constexpr double degree = std::numbers::pi / 180.0;
  double east = 0.0, north = 0.0, speeds = 0.0;
  for (const WeatherHour& record : records)
  {
    if (record.windFrom && record.windSpeed)
    {
      east += *record.windSpeed * std::sin(*record.windFrom * degree);
      north += *record.windSpeed * std::cos(*record.windFrom * degree);
      speeds += *record.windSpeed;
    }
  }
  constexpr double rounding = 1e-9;
  const double angle = std::atan2(east, north) / degree;
  return std::hypot(east, north) > rounding * speeds ? std::optional(angle < 0.0 ? angle + 360.0 : angle)
                                                     : std::nullopt;
}

WeatherHour hourOf(const std::vector<WeatherHour>& records)
{
  WeatherHour hour = records.front();
  if (records.size() > 1)
  {
    hour.temperature = meanOf(records, &WeatherHour::temperature);
    hour.windSpeed = meanOf(records, &WeatherHour::windSpeed);
    hour.windFrom = meanDirection(records);
  }
  return hour;
}

} // namespace

int daysIn(int month)
{
  constexpr std::array days{31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  return days.at(static_cast<std::size_t>(month - 1));
}

void checkLeapDay(const LineReader& place, std::string_view year, const Day& day)
{
  const double number = numberFrom(year).value_or(0.0);
  const auto isDivisibleBy = [number](int divisor) { return std::fmod(number, divisor) == 0.0; };
  const bool isLeap = isDivisibleBy(4) && (!isDivisibleBy(100) || isDivisibleBy(400));
  if (day == Day{2, 29} && number >= 1.0 && isDivisibleBy(1) && !isLeap)
  {
    place.fail("2/29 does not exist in " + shortNumber(number) +
               ", which is no leap year: correct the year, or remove the day");
  }
}

bool isNextDay(const Day& before, const Day& after)
{
  if (after.month == before.month)
  {
    return after.day == before.day + 1;
  }
  const int last = before.month == 2 ? 28 : daysIn(before.month);
  return after.month == before.month % 12 + 1 && after.day == 1 && before.day >= last;
}

HourSequence::HourSequence(HourPlan planned) : plan(std::move(planned)), passesLeft(plan.periods.front().passes) {}

void HourSequence::add(const WeatherHour& record, const LineReader& place)
{
  if (records.empty())
  {
    checkNext(record, place);
  }
  else if (!isSameHour(record, records.back()))
  {
    place.fail(nameOf(records.back()) + " has " + std::to_string(records.size()) + " records; " + plan.source +
               " says " + std::to_string(plan.recordsPerHour) + " an hour: get the file again, or correct either");
  }
  records.push_back(record);
  if (records.size() == static_cast<std::size_t>(plan.recordsPerHour))
  {
    completeHour();
  }
}

void HourSequence::checkNext(const WeatherHour& record, const LineReader& place) const
{
  const Day& first = plan.periods[period].first;
  if (!before && !(Day{record.month, record.day} == first && record.hour == 1))
  {
    place.fail(nameOf(record) + " stands where " + plan.source + " has hour 1 of " + std::to_string(first.month) + "/" +
               std::to_string(first.day) + ": get the file again, or correct either");
  }
  if (before && isSameHour(*before, record))
  {
    place.fail(nameOf(record) + " is there more than " +
               (plan.recordsPerHour == 1 ? "once" : std::to_string(plan.recordsPerHour) + " times") + ", and " +
               plan.source + " has " + std::to_string(plan.recordsPerHour) + " an hour: remove what is too much");
  }
  if (before && !isNextHour(*before, record))
  {
    place.fail(nameOf(record) + " comes after " + nameOf(*before) +
               "; hours must follow each other: get the file again, or add what is missing with the codes for missing "
               "values");
  }
}

void HourSequence::completeHour()
{
  hours.push_back(hourOf(records));
  before = hours.back();
  records.clear();
  const bool isLast = before->hour == 24 && Day{before->month, before->day} == plan.periods[period].last;
  if (isLast && --passesLeft == 0)
  {
    period = (period + 1) % plan.periods.size();
    passesLeft = plan.periods[period].passes;
    before.reset();
  }
}

std::vector<WeatherHour> HourSequence::finish(const LineReader& place)
{
  if (hours.empty() && records.empty())
  {
    place.fail("the file ends after its header and holds no hours; get it again");
  }
  const DataPeriod& open = plan.periods[period];
  if (before || !records.empty() || period != 0)
  {
    place.fail("the file ends with " + nameOf(records.empty() ? hours.back() : records.back()) + ", and " +
               plan.source + " goes on to " + std::to_string(open.last.month) + "/" + std::to_string(open.last.day) +
               ": it is truncated, get it again");
  }
  return std::move(hours);
}

} // namespace atria::weather
