// SPDX-License-Identifier: GPL-3.0-or-later
#include "CaseOptions.h"

#include "Commands.h"
#include "Numbers.h"

#include <vtkAtriaOpenFOAMCaseWriter.h>
#include <vtkNew.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace atria::tool {

namespace {

using Words = std::vector<std::string>;
/// In the order of vtkAtriaOpenFOAMCaseWriter's numbers.
const Words turbulenceModels{"k-epsilon", "realizable", "k-omega-sst"};
const Words dialects{"opencfd-1912", "opencfd-2006", "foundation-11", "foundation-14"};
const Words kinds{"automatic", "wind", "room"};

/// Returns the number of directions that --rose gives; nothing if it names a file.
std::optional<int> roseNumber(const std::string& text)
{
  double number = 0.0;
  return readNumber(text, number) ? std::optional(static_cast<int>(number)) : std::nullopt;
}

/// Accepts a whole number in a range, or the name of a file that exists.
CLI::Validator numberOrFile(int least, int most)
{
  return CLI::Validator(
      [=](std::string& input) {
        double number = 0.0;
        const bool isNumber = readNumber(input, number);
        const bool fits = isNumber ? number >= least && number <= most && number == std::floor(number)
                                   : std::filesystem::is_regular_file(input);
        return fits ? std::string()
                    : "'" + input + "' is neither a whole number from " + std::to_string(least) + " to " +
                          std::to_string(most) + " nor a file";
      },
      "");
}

void declareWind(CLI::App& command, CaseOptions& options)
{
  vtkNew<vtkAtriaOpenFOAMCaseWriter> standard; // the one home of the defaults
  options.speed = standard->GetReferenceSpeed();
  options.height = standard->GetReferenceHeight();
  options.roughness = standard->GetRoughnessLength();
  const auto length = [&](const char* name, double& value, const char* text, const char* unit) {
    command.add_option(name, value, text)->capture_default_str()->check(positive())->type_name(unit);
  };
  length("--speed", options.speed, "Speed of the wind at the reference height, m/s", "M/S");
  length("--height", options.height, "Reference height above the ground, meters", "M");
  length("--roughness", options.roughness,
         "Roughness length of the ground, meters: 0.03 grass, 0.1 farmland, 0.5 suburbs, 1 and more cities", "M");
  auto* wind = command
                   .add_option("--wind", options.wind,
                               "Where the wind blows to, degrees from x, counterclockwise from above; one run each "
                               "(default: from the domain's xMin to its xMax, or into its domainSide1)")
                   ->check(numberIn(-360.0, 360.0))
                   ->type_name("DEG");
  auto* from = command
                   .add_option("--from", options.from,
                               "Where the wind comes from, degrees clockwise from north: 270 is west; one run each")
                   ->check(numberIn(0.0, 360.0))
                   ->type_name("DEG");
  from->excludes(wind);
  command
      .add_option("--rose", options.rose,
                  "Runs for this many directions at equal steps, the first from north; or for those with a frequency "
                  "above 0 in a table of `atria climate`")
      ->check(
          numberOrFile(standard->GetNumberOfRoseDirectionsMinValue(), standard->GetNumberOfRoseDirectionsMaxValue()))
      ->excludes(wind)
      ->excludes(from)
      ->type_name("N|FILE.csv");
  command.add_flag(
      "--check-profile", options.checkProfile,
      "Also write the domain without buildings, empty_domain, which runs in less than a minute: atria report "
      "then says how far the wind's profile changes before the buildings");
  command.add_option("--north", options.north, "Where north lies, degrees from y, counterclockwise from above")
      ->capture_default_str()
      ->check(numberIn(-360.0, 360.0))
      ->type_name("DEG");
}

void declareRoom(CLI::App& command, CaseOptions& options)
{
  vtkNew<vtkAtriaOpenFOAMCaseWriter> standard;
  options.kind = kinds[static_cast<std::size_t>(standard->GetKind())];
  options.inletSpeed = standard->GetInletSpeed();
  options.inletFlow = standard->GetInletFlowRate();
  command
      .add_option("--kind", options.kind,
                  "What moves the air: wind, or inlets of a room; automatic: a room where no wind direction is given, "
                  "patches are inlets and outlets by name or by --patch, and all others are walls")
      ->capture_default_str()
      ->check(oneOf(kinds))
      ->type_name("automatic|wind|room");
  auto* speed = command
                    .add_option("--inlet-speed", options.inletSpeed,
                                "Speed of the air from each inlet of a room, along the inlet's normal, m/s")
                    ->capture_default_str()
                    ->check(numberIn(standard->GetInletSpeedMinValue(), standard->GetInletSpeedMaxValue()))
                    ->type_name("M/S");
  command
      .add_option("--inlet-flow", options.inletFlow, "Air from each inlet of a room, m3/s, instead of --inlet-speed")
      ->check(numberIn(standard->GetInletFlowRateMinValue(), standard->GetInletFlowRateMaxValue()))
      ->excludes(speed)
      ->type_name("M3/S");
}

void declareWarmAir(CLI::App& command, CaseOptions& options)
{
  vtkNew<vtkAtriaOpenFOAMCaseWriter> standard;
  command
      .add_option(
          "--outdoor-temperature", options.outdoorTemperature,
          "Temperature of the air outdoors, degrees Celsius: the air takes up heat, and rises where it is warmer")
      ->check(celsius(standard->GetOutdoorTemperatureMinValue(), standard->GetOutdoorTemperatureMaxValue()))
      ->type_name("CELSIUS");
  command
      .add_option(
          "--heat", options.heats,
          "Heat of the cell zones whose name matches, or else of the surfaces: W of all together (Office 600W), or "
          "W/m2 of surfaces (Floor 50W/m2); may be repeated, heat adds up")
      ->allow_extra_args(false)
      ->type_name("PATTERN AMOUNT");
  command
      .add_option("--temperature", options.temperatures,
                  "Temperature of the surfaces whose name matches, or of the air that comes in at inlets and openings, "
                  "degrees Celsius; may be repeated, the last holds")
      ->allow_extra_args(false)
      ->type_name("PATTERN CELSIUS");
  command.add_flag(
      "--calm", options.calm,
      "No wind: warmth, fans and inlets of a given amount move the air. Sides and top of the domain are open to "
      "air at rest, and so are a room's other inlets and outlets");
  command
      .add_option("--transient", options.transient,
                  "Compute this time from air at rest, seconds, instead of a steady flow (which air without wind may "
                  "not have)")
      ->check(numberIn(0.0, standard->GetTransientDurationMaxValue(), true))
      ->type_name("SECONDS");
}

void declarePatches(CLI::App& command, CaseOptions& options)
{
  command
      .add_option(
          "--patch", options.patchRules,
          "What the patches are whose name matches: inlet, inlet:AMOUNT (which blows along its normal; m/s, m3/s, m3/h "
          "or l/s, such as inlet:0.5m/s), outlet, inletOutlet (by the flow), slip, ground, wall or rough:SIZE (sand "
          "grains, meters); may be repeated, the last holds")
      ->allow_extra_args(false)
      ->type_name("PATTERN ROLE");
  command
      .add_option(
          "--ground", options.grounds,
          "Roughness length, meters, of the surfaces whose name matches, which become ground; or a kind: water, "
          "smooth, grass, crops, highCrops, parkland, suburb, forest, city; may be repeated, the last holds")
      ->allow_extra_args(false)
      ->type_name("PATTERN LENGTH|KIND");
  command
      .add_option(
          "--condition", options.conditions,
          "Entries of the patches whose name matches in one field, as in OpenFOAM's dictionaries; may be repeated")
      ->allow_extra_args(false)
      ->type_name("PATTERN FIELD ENTRIES");
}

/// Declares what the air carries, and what slows or moves it on its way.
void declareContents(CLI::App& command, CaseOptions& options)
{
  command
      .add_option(
          "--scalar", options.scalars,
          "Also compute what the air carries, such as CO2 or smoke: a source per second in the cell zones or on "
          "the walls whose name matches (CO2 Office 5e-6/s), or the concentration of the air that comes in "
          "there (CO2 Inlet 400e-6); may be repeated, sources add up")
      ->allow_extra_args(false)
      ->type_name("NAME PATTERN AMOUNT");
  command
      .add_option(
          "--canopy", options.canopies,
          "Leaves in the cell zones whose name matches slow the air: leaf area density, 1/m, and drag coefficient, "
          "such as Hedge 2 0.2; may be repeated, the last holds")
      ->allow_extra_args(false)
      ->type_name("PATTERN LAD CD");
  command
      .add_option("--trees", options.trees,
                  "Table of trees, lines of x, y, height, crown radius, LAD, Cd: cells in their crowns slow the air")
      ->check(CLI::ExistingFile)
      ->type_name("FILE.csv");
  command
      .add_option(
          "--screen", options.screens,
          "Porous screens in the face zones whose name matches: loss coefficient, such as Window 2.5, or with a linear "
          "part in Pa for each m/s, such as Window 2.5,0.4; may be repeated, the last holds")
      ->allow_extra_args(false)
      ->type_name("PATTERN RESISTANCE");
  command
      .add_option("--fan", options.fans,
                  "Fans in the face zones whose name matches: pressure rise along the zone's normal, Pa, negative "
                  "against it, or a table of flow rate, m3/s, and pressure; may be repeated, the last holds")
      ->allow_extra_args(false)
      ->type_name("PATTERN PRESSURE|FILE.csv");
}

void declareRun(CLI::App& command, CaseOptions& options)
{
  vtkNew<vtkAtriaOpenFOAMCaseWriter> standard;
  options.turbulence = turbulenceModels[static_cast<std::size_t>(standard->GetTurbulenceModel())];
  options.dialect = dialects[static_cast<std::size_t>(standard->GetDialect())];
  options.iterations = standard->GetNumberOfIterations();
  options.processors = standard->GetNumberOfProcessors();
  options.pedestrian = standard->GetPedestrianHeight();
  command.add_option("--turbulence", options.turbulence, "Model of turbulence")
      ->capture_default_str()
      ->check(oneOf(turbulenceModels))
      ->type_name("k-epsilon|realizable|k-omega-sst");
  command.add_option("--iterations", options.iterations, "Iterations of the solver, at most")
      ->capture_default_str()
      ->check(numberIn(standard->GetNumberOfIterationsMinValue(), standard->GetNumberOfIterationsMaxValue()))
      ->type_name("N");
  command.add_option("--processors", options.processors, "Processors to run on")
      ->capture_default_str()
      ->check(numberIn(standard->GetNumberOfProcessorsMinValue(), standard->GetNumberOfProcessorsMaxValue()))
      ->type_name("N");
  command.add_flag("--age-of-air", options.age, "Also compute the age of the air, seconds since it came in");
  command
      .add_option("--pedestrian-height", options.pedestrian,
                  "Height above the ground where speeds are measured, meters")
      ->capture_default_str()
      ->check(positive())
      ->type_name("M");
  command
      .add_option(
          "--dialect", options.dialect,
          "Whose OpenFOAM, and from which version on: opencfd-1912 is Debian's, opencfd-2006 suits v2006 to v2512, "
          "foundation-11 11 to 13, foundation-14 14 and later")
      ->capture_default_str()
      ->check(oneOf(dialects))
      ->type_name("opencfd-1912|opencfd-2006|foundation-11|foundation-14");
}

int numberOf(const Words& words, const std::string& word)
{
  return static_cast<int>(std::find(words.begin(), words.end(), word) - words.begin());
}

/// Sets where the wind comes from: equal steps, a table, or single directions.
void setDirections(vtkAtriaOpenFOAMCaseWriter* writer, const CaseOptions& options)
{
  if (!options.rose.empty())
  {
    const std::optional<int> steps = roseNumber(options.rose);
    writer->SetNumberOfRoseDirections(steps.value_or(0));
    writer->SetRoseFileName(steps ? nullptr : options.rose.c_str());
  }
  for (const double angle : options.wind)
  {
    writer->AddWindAngle(angle);
  }
  for (const double from : options.from)
  {
    writer->AddWindAngle(std::remainder(270.0 + options.north - from, 360.0));
  }
}

std::string text(const std::string& pattern, const std::string& rest)
{
  std::ostringstream rule;
  rule << std::quoted(pattern) << ' ' << rest;
  return rule.str();
}

/// Sets what the air carries, what slows or moves it, and its warmth.
void addContents(vtkAtriaOpenFOAMCaseWriter* writer, const CaseOptions& options)
{
  for (const auto& [name, pattern, amount] : options.scalars)
  {
    writer->AddScalarRule((name + " " + text(pattern, amount)).c_str());
  }
  for (const auto& [pattern, density, drag] : options.canopies)
  {
    writer->AddCanopyRule(text(pattern, std::string(density).append(" ").append(drag)).c_str());
  }
  if (!options.trees.empty())
  {
    writer->SetTreeFile(options.trees.c_str());
  }
  for (const auto& [pattern, resistance] : options.screens)
  {
    writer->AddScreenRule(text(pattern, resistance).c_str());
  }
  for (const auto& [pattern, pressure] : options.fans)
  {
    std::ostringstream quoted;
    quoted << std::quoted(pressure);
    writer->AddFanRule(text(pattern, quoted.str()).c_str());
  }
  writer->SetWarmAir(options.outdoorTemperature.has_value());
  writer->SetOutdoorTemperature(options.outdoorTemperature.value_or(writer->GetOutdoorTemperature()));
  writer->SetCalm(options.calm);
  writer->SetTransientDuration(options.transient);
  for (const auto& [pattern, celsius] : options.temperatures)
  {
    writer->AddTemperatureRule(text(pattern, celsius).c_str());
  }
  for (const auto& [pattern, amount] : options.heats)
  {
    writer->AddHeatRule(text(pattern, amount).c_str());
  }
}

} // namespace

void declareCaseOptions(CLI::App& command, CaseOptions& options)
{
  const auto group = [&](const char* name) { command.option_defaults()->group(name); };
  group("Mesh");
  command.add_option("MESH", options.input, "Mesh: a .vtu file of `atria mesh`, or the folder of an OpenFOAM case");
  command.add_option("--patches", options.patches,
                     "FILE.vtpc with the mesh's patches (default: those recorded in the mesh)");
  command.add_option("-o,--output", options.output, "Folder of the case; may be that of MESH")->type_name("DIR");
  group("Wind");
  declareWind(command, options);
  group("Room");
  declareRoom(command, options);
  group("Warm air");
  declareWarmAir(command, options);
  group("Patches");
  declarePatches(command, options);
  group("Run");
  declareContents(command, options);
  declareRun(command, options);
}

void configureCase(vtkAtriaOpenFOAMCaseWriter* writer, const CaseOptions& options, const CLI::App& command)
{
  writer->SetKind(numberOf(kinds, options.kind));
  writer->SetInletQuantity(command.count("--inlet-flow") > 0 ? vtkAtriaOpenFOAMCaseWriter::ByFlowRate
                                                             : vtkAtriaOpenFOAMCaseWriter::BySpeed);
  writer->SetInletSpeed(options.inletSpeed);
  writer->SetInletFlowRate(options.inletFlow);
  writer->WriteBinaryOn();
  writer->SetCaseDirectory(options.output.c_str());
  writer->SetReferenceSpeed(options.speed);
  writer->SetReferenceHeight(options.height);
  writer->SetRoughnessLength(options.roughness);
  writer->SetNorthAngle(options.north);
  setDirections(writer, options);
  writer->SetTurbulenceModel(numberOf(turbulenceModels, options.turbulence));
  writer->SetDialect(numberOf(dialects, options.dialect));
  writer->SetNumberOfIterations(options.iterations);
  writer->SetNumberOfProcessors(options.processors);
  writer->SetPedestrianHeight(options.pedestrian);
  writer->SetAgeOfAir(options.age);
  writer->SetCheckProfile(options.checkProfile);
  addContents(writer, options);
  for (const auto& [pattern, role] : options.patchRules)
  {
    writer->AddPatchRule(text(pattern, role).c_str());
  }
  for (const auto& [pattern, roughness] : options.grounds)
  {
    writer->AddGroundRule(text(pattern, roughness).c_str());
  }
  for (const auto& [pattern, field, entries] : options.conditions)
  {
    writer->AddConditionRule(text(pattern, std::string(field).append(" ").append(entries)).c_str());
  }
}

} // namespace atria::tool
