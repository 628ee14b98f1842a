// SPDX-License-Identifier: GPL-3.0-or-later
#include "WeatherClimate.h"

#include "Support/Error.h"
#include "WeatherText.h"

#include <algorithm>
#include <utility>

namespace atria::weather {

namespace {

/// Returns the filter without temperatures.
HourFilter filterOf(const ClimateOptions& options, double latitude)
{
  HourFilter filter{std::nullopt, options.time};
  if (options.season)
  {
    filter.months = monthsOf(*options.season, latitude);
  }
  filter.months = options.months.value_or(filter.months);
  return filter;
}

std::string textOf(const TemperatureRange& range)
{
  return shortNumber(range.least) + " to " + shortNumber(range.most);
}

/// Returns the range of the temperatures that are known; nothing if none is.
std::optional<TemperatureRange> rangeOf(const std::vector<WeatherHour>& hours)
{
  std::optional<TemperatureRange> range;
  for (const WeatherHour& hour : hours)
  {
    if (hour.temperature)
    {
      const double value = *hour.temperature;
      range = range ? TemperatureRange{std::min(range->least, value), std::max(range->most, value)}
                    : TemperatureRange{value, value};
    }
  }
  return range;
}

/// Returns advice on limits that no outdoor temperature in degrees Celsius reaches.
std::string adviceOnKelvin(const TemperatureRange& range)
{
  constexpr double leastOfKelvin = 200.0;
  constexpr double freezing = 273.15;
  return range.least > leastOfKelvin ? "; the limits look like kelvin: write " +
                                           textOf({range.least - freezing, range.most - freezing}) + " degrees Celsius"
                                     : "";
}

/// Throws Error for hours none of which has a temperature in the range. `selected` are those that pass the filter but
/// for their temperatures.
[[noreturn]] void refuse(const TemperatureRange& range, const std::vector<WeatherHour>& selected,
                         const std::vector<WeatherHour>& all)
{
  const std::string hours =
      selected.size() == all.size() ? "no hour" : "none of the " + withCommas(selected.size()) + " hours selected";
  const std::optional<TemperatureRange> found = rangeOf(selected);
  const std::optional<TemperatureRange> inFile = rangeOf(all);
  if (!inFile)
  {
    throw Error(
        "no hour of the file has a known temperature; leave out the range of temperatures, or take another file");
  }
  if (!found)
  {
    throw Error(hours + " has a known temperature; select other hours, or leave out the range of temperatures");
  }
  throw Error(hours + " has a temperature from " + textOf(range) + " C; " +
              (selected.size() == all.size() ? "" : "these have " + textOf(*found) + " C, and ") + "the file has " +
              textOf(*inFile) + " C" + adviceOnKelvin(range));
}

std::string hoursLack(std::size_t hours, const char* what)
{
  return hours == 0 ? "" : withCommas(hours) + (hours == 1 ? " lacks its " : " lack their ") + what;
}

/// Returns a text on missing values, which is grave where they are many.
std::vector<Warning> missingDoubts(const Climate& climate)
{
  const auto [temperature, wind] = climate.missing;
  if (temperature + wind == 0)
  {
    return {};
  }
  constexpr double manyShare = 0.1;
  const std::size_t all = climate.weather.hours.size();
  const std::string text = "of " + withCommas(all) + " hours, " + hoursLack(temperature, "temperature") +
                           (temperature > 0 && wind > 0 ? " and " : "") + hoursLack(wind, "wind") +
                           "; statistics that need the value leave them out";
  const bool areMany = static_cast<double>(std::max(temperature, wind)) > manyShare * static_cast<double>(all);
  return {areMany ? Warning{text + ". That is more than a tenth: take another file or station if there is one",
                            Gravity::grave}
                  : Warning{text}};
}

std::vector<Warning> fewHoursDoubts(const Climate& climate)
{
  std::string names;
  for (const RoseSector& sector : climate.rose.sectors)
  {
    names += sector.hasOwnShape ? "" : (names.empty() ? "" : ", ") + shortNumber(sector.from);
  }
  if (names.empty())
  {
    return {};
  }
  return {{"fewer than " + std::to_string(leastHoursForShape) + " hours of wind from " + names +
           " degrees: their shape is that of all sectors together; keep more hours, or take fewer sectors"}};
}

} // namespace

void checkOptions(const ClimateOptions& options)
{
  if (options.ventilation.least > options.ventilation.most)
  {
    throw Error("the range of temperatures is " + textOf(options.ventilation) + ": the lower one comes first");
  }
  if (options.time.from == options.time.to)
  {
    throw Error("between two equal times of day there are no hours; for the whole day take 0 to 24");
  }
  if (options.season && options.months)
  {
    throw Error("a season and months exclude each other: give one of them");
  }
}

Climate climateOf(Weather weather, const ClimateOptions& options)
{
  checkOptions(options);
  Climate climate;
  climate.weather = std::move(weather);
  climate.options = options.rose;
  const std::vector<WeatherHour>& all = climate.weather.hours;
  climate.missing = missingIn(all, options.rose.calmSpeed);
  HourFilter filter = filterOf(options, climate.weather.station.latitude);
  const std::vector<WeatherHour> selected = hoursKept(all, filter);
  climate.ventilation = options.ventilation;
  climate.ventilated = countIn(selected, options.ventilation);
  if (selected.empty())
  {
    throw Error("the file has no hours in these months and times of day; select others");
  }
  if (options.onlyVentilated)
  {
    filter.temperature = options.ventilation;
  }
  const std::vector<WeatherHour> kept = hoursKept(all, filter);
  climate.kept = kept.size();
  if (kept.empty())
  {
    refuse(options.ventilation, selected, all);
  }
  climate.rose = windRoseOf(kept, options.rose);
  climate.hasUnevenSectors = dividesRoundedDirections(all, options.rose.sectors);
  return climate;
}

Climate readClimate(const std::filesystem::path& file, const ClimateOptions& options)
{
  checkOptions(options);
  Weather weather = readWeather(file);
  try
  {
    return climateOf(std::move(weather), options);
  }
  catch (const Error& error)
  {
    throw Error(file.string() + ": " + error.what());
  }
}

std::vector<Warning> doubtsOf(const Climate& climate)
{
  std::vector<Warning> doubts = missingDoubts(climate);
  for (const Warning& doubt : fewHoursDoubts(climate))
  {
    doubts.push_back(doubt);
  }
  if (climate.hasUnevenSectors)
  {
    doubts.push_back({"directions are rounded to 10 degrees, and " + std::to_string(climate.options.sectors) +
                          " sectors do not hold equally many of them: take 4, 12 or 36",
                      Gravity::grave});
  }
  return doubts;
}

std::string withCommas(std::size_t number)
{
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;)
  {
    at -= 3;
    text.insert(at, ",");
  }
  return text;
}

} // namespace atria::weather
