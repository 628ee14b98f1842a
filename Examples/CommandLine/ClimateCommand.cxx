// SPDX-License-Identifier: GPL-3.0-or-later
/// atria climate: makes a wind rose and a table of the wind's climate from a weather file.
#include "ClimateReport.h"
#include "Commands.h"
#include "ConfigFile.h"
#include "Console.h"
#include "Files.h"
#include "Numbers.h"
#include "OutputFiles.h"

#include <ClimateTable.h>
#include <RosePicture.h>
#include <Support/Error.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace atria::tool {

namespace {

/// In the order of weather::Season.
const std::vector<std::string> seasons{"spring", "summer", "autumn", "winter"};

struct Options
{
  std::string input;
  std::string output;
  std::string picture;
  std::string writeConfig;
  std::vector<double> temperature;
  std::vector<int> hours;
  std::string season;
  std::string months;
  weather::RoseOptions rose;
  bool json = false;
};

constexpr const char* examples = R"(Examples:
  atria climate city.epw
      the wind rose of a year, and how many hours suit natural ventilation
  atria climate city.epw -o climate.csv --picture rose.svg
      the table for `atria report --climate` and `atria case --rose`, and a picture
  atria climate city.epw --temperature 18 26 --hours 8 18 --months 4-9 -o climate.csv
      of the hours between 8 and 18 o'clock, April to September, in which it is 18 to 26 degrees Celsius)";

/// Accepts a list of months.
CLI::Validator monthList()
{
  return CLI::Validator(
      [](std::string& input) {
        try
        {
          weather::monthsFrom(input);
          return std::string();
        }
        catch (const Error& error)
        {
          return std::string(error.what());
        }
      },
      "");
}

void declareHours(CLI::App& command, Options& options)
{
  const weather::TemperatureRange standard;
  std::ostringstream text;
  text << "Keep hours with these outdoor temperatures, degrees Celsius (default: all; the share of hours for natural "
          "ventilation is that of "
       << standard.least << " to " << standard.most << ")";
  command.add_option("--temperature", options.temperature, text.str())
      ->expected(2)
      ->check(anyNumber())
      ->type_name("MIN MAX");
  command
      .add_option("--hours", options.hours,
                  "Keep hours between these times of day, full hours; over midnight if FROM is later than TO")
      ->expected(2)
      ->check(numberIn(0.0, 24.0))
      ->type_name("FROM TO");
  auto* season =
      command
          .add_option("--season", options.season,
                      "Keep the three months of a season; in the southern hemisphere spring begins in September")
          ->check(oneOf(seasons))
          ->type_name("spring|summer|autumn|winter");
  command.add_option("--months", options.months, "Keep these months, such as 4-9, 11-2 (over the new year) or 1,6-8")
      ->check(monthList())
      ->excludes(season)
      ->type_name("LIST");
}

void declareRose(CLI::App& command, Options& options)
{
  command.add_option("--sectors", options.rose.sectors, "Equal sectors of the rose, the first around north")
      ->capture_default_str()
      ->check(numberIn(4.0, 72.0))
      ->type_name("N");
  command
      .add_option("--calm", options.rose.calmSpeed,
                  "Slower hours are calm, m/s: they have no direction, and are shared out among the sectors")
      ->capture_default_str()
      ->check(atLeast(0.0))
      ->type_name("M/S");
}

void declareOutput(CLI::App& command, Options& options)
{
  command
      .add_option("-o,--output", options.output,
                  "Write a table with the columns from, frequency, scale and shape, for `atria report --climate` and "
                  "`atria case --rose`")
      ->type_name("FILE.csv");
  command.add_option("--picture", options.picture, "Draw the rose")->type_name("FILE.svg");
  command.add_flag("--json", options.json, "Print JSON");
  declareConfigFile(command, options.writeConfig, "do nothing else");
}

weather::ClimateOptions coreOptions(const Options& options)
{
  weather::ClimateOptions result;
  if (!options.temperature.empty())
  {
    result.ventilation = {options.temperature[0], options.temperature[1]};
    result.onlyVentilated = true;
  }
  if (!options.hours.empty())
  {
    result.time = {options.hours[0], options.hours[1]};
  }
  if (!options.season.empty())
  {
    const auto season = std::find(seasons.begin(), seasons.end(), options.season) - seasons.begin();
    result.season = static_cast<weather::Season>(season);
  }
  if (!options.months.empty())
  {
    result.months = weather::monthsFrom(options.months);
  }
  result.rose = options.rose;
  return result;
}

void checkOptions(const Options& options)
{
  if (options.input.empty())
  {
    throw Failure(Usage, "WEATHER is required: name an .epw file, or a .csv file of TMY3");
  }
  try
  {
    weather::checkOptions(coreOptions(options));
  }
  catch (const Error& error)
  {
    throw Failure(Usage, error.what());
  }
  if (!options.output.empty())
  {
    checkOutput("--output", options.output, ".csv");
  }
  if (!options.picture.empty())
  {
    checkOutput("--picture", options.picture, ".svg");
  }
}

std::string wordsOn(const Options& options)
{
  std::ostringstream words;
  const auto add = [&]() -> std::ostream& { return words << (words.tellp() > 0 ? ", " : ""); };
  if (!options.temperature.empty())
  {
    add() << options.temperature[0] << " to " << options.temperature[1] << " °C";
  }
  if (!options.hours.empty())
  {
    add() << options.hours[0] << " to " << options.hours[1] << " o'clock";
  }
  if (!options.season.empty())
  {
    add() << options.season;
  }
  if (!options.months.empty())
  {
    add() << "months " << options.months;
  }
  return words.str();
}

Climate climateOf(const Options& options)
{
  return {weather::readClimate(options.input, coreOptions(options)), options.input, wordsOn(options)};
}

void writeFiles(const Climate& climate, const Options& options)
{
  if (!options.output.empty())
  {
    writeText(options.output, weather::csvOf(weather::tableOf(climate.rose)));
  }
  if (!options.picture.empty())
  {
    writeText(options.picture, weather::rosePicture(climate.rose, {titleOf(climate), subtitleOf(climate)}));
  }
}

void print(const Climate& climate, const Options& options)
{
  if (options.json)
  {
    std::cout << jsonOf(climate).dump(2) << '\n';
    return;
  }
  printClimate(climate);
  if (!options.output.empty())
  {
    std::cout << "\nUse it: atria case MESH -o CASE --rose " << options.output
              << "\n        atria report CASE --climate " << options.output << " --station 10 0.03\n";
  }
}

ExitStatus runClimate(const Options& options, const CLI::App& command, Console& console)
{
  if (writesConfigFile(command, options.writeConfig))
  {
    return Done;
  }
  checkOptions(options);
  try
  {
    const Climate climate = climateOf(options);
    noteDoubts(climate, console);
    writeFiles(climate, options);
    print(climate, options);
  }
  catch (const Error& error)
  {
    throw Failure(BadInput, error.what());
  }
  return Done;
}

} // namespace

void addClimateCommand(CLI::App& app, Console& console, ExitStatus& status)
{
  CLI::App* command =
      app.add_subcommand("climate", "Make a wind rose of a weather file, for wind comfort and natural ventilation");
  command->fallthrough(); // to --config
  auto options = std::make_shared<Options>();
  const auto group = [&](const char* name) { command->option_defaults()->group(name); };
  group("Weather");
  command->add_option("WEATHER", options->input,
                      "A year's weather, hour by hour: .epw of EnergyPlus, or .csv of NREL's TMY3");
  group("Hours");
  declareHours(*command, *options);
  group("Wind rose");
  declareRose(*command, *options);
  group("Output");
  declareOutput(*command, *options);
  command->footer(examples);
  command->callback([options, command, &console, &status] { status = runClimate(*options, *command, console); });
}

} // namespace atria::tool
