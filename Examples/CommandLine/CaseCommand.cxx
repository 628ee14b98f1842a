// SPDX-License-Identifier: GPL-3.0-or-later
/// atria case: makes an OpenFOAM case that runs from a mesh.
#include "CaseOptions.h"
#include "Commands.h"
#include "ConfigFile.h"
#include "Console.h"
#include "Files.h"
#include "InputFiles.h"

#include <vtkAtriaOpenFOAMCaseWriter.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace atria::tool {

namespace {

namespace fs = std::filesystem;

using Words = std::vector<std::string>;
/// Options of one kind of case that the other does not take.
const Words windOptions{"--speed", "--height", "--roughness", "--north", "--ground", "--check-profile"};
const Words blowingOptions{"--speed", "--height", "--check-profile"};
const Words roomOptions{"--inlet-speed", "--inlet-flow"};

constexpr const char* examples = R"(Examples:
  atria case house.vtu -o case --speed 4 --roughness 0.5 && case/Allrun
      wind of 4 m/s at 10 m over suburbs, along the domain from xMin to xMax
  atria case house.vtu -o case --rose 12 --processors 4
      twelve directions, which share the mesh; each runs on four processors
  atria case house.vtu -o case --rose climate.csv
      the directions of a table of `atria climate` that wind comes from
  atria case house.vtu -o case --ground Lawn grass --ground 'Road*' 0.005 --check-profile
      grounds by the names of their surfaces; how far the wind's profile changes before the buildings
  atria case openfoam -o case --from 225 --turbulence k-omega-sst --patch 'Glass*' slip
      the mesh of an OpenFOAM case, wind from the southwest, another model of turbulence, walls without friction
  atria case room.vtu -o case --inlet-flow 0.05 --age-of-air
      a room, whose openings are called Inlet and Outlet, or Supply_1 and Exhaust: 50 l/s through each inlet
  atria case house.vtu -o case --calm --outdoor-temperature 20 --heat 'room_*' 2000W
      air that warm rooms move, without wind
  atria case room.vtu -o case --patch East inlet:0.5m/s --patch West outlet
      a room whose openings have other names))";

bool writeCase(vtkAtriaOpenFOAMCaseWriter* writer, const CaseOptions& options, Console& console)
{
  console.follow(writer, 0.5, 1.0);
  if (fs::is_directory(options.input))
  {
    return writer->WriteForMesh(options.input.c_str()) != 0;
  }
  const auto mesh = readMesh(options.input, console);
  writer->SetInputDataObject(0, mesh);
  if (!options.patches.empty())
  {
    writer->SetInputDataObject(1, readPatches(options.patches, console));
  }
  return writer->Write() != 0;
}

/// Warns of options that the case has no use for; a file for --config may hold them.
void warnOfUnused(vtkAtriaOpenFOAMCaseWriter* writer, const CaseOptions& options, const CLI::App& command,
                  Console& console)
{
  const bool isRoom = writer->GetWrittenKind() == vtkAtriaOpenFOAMCaseWriter::Room;
  for (const std::string& option : isRoom ? windOptions : roomOptions)
  {
    if (command.count(option) > 0)
    {
      console.warning(
          option + (isRoom
                        ? " is for wind, and this is a room: see --inlet-speed, --inlet-flow and --kind"
                        : " is for rooms, and this is a case of wind: see --patch PATTERN inlet:AMOUNT, and --kind"));
    }
  }
  for (const std::string& option : isRoom ? roomOptions : blowingOptions)
  {
    if (options.calm && command.count(option) > 0)
    {
      console.warning(option + " has no use with --calm: nothing blows");
    }
  }
}

ExitStatus runCase(const CaseOptions& options, const CLI::App& command, Console& console)
{
  if (writesConfigFile(command, options.writeConfig))
  {
    return Done;
  }
  if (options.input.empty() || options.output.empty())
  {
    throw Failure(Usage, options.input.empty() ? "MESH is required: name a .vtu file or the folder of an OpenFOAM case"
                                               : "--output is required: name the folder of the case");
  }
  checkFolder("--output", options.output);
  vtkNew<vtkAtriaOpenFOAMCaseWriter> writer;
  configureCase(writer, options, command);
  const bool written = writeCase(writer, options, console);
  Console::throwIfInterrupted();
  const bool isFull = writer->GetErrorCode() == vtkErrorCode::CannotOpenFileError;
  throwIfErrors(console, isFull ? Failed : BadInput, isFull ? options.output : options.input);
  console.clearBar();
  if (!written)
  {
    throw Failure(Failed, options.output + ": the case could not be written; check permissions and space");
  }
  warnOfUnused(writer, options, command, console);
  if (!writer->GetSummary().empty())
  {
    std::cout << writer->GetSummary() << "\n";
  }
  std::cout << "Run it: " << (fs::path(options.output) / "Allrun").string() << "\n";
  return Done;
}

} // namespace

void addCaseCommand(CLI::App& app, Console& console, ExitStatus& status)
{
  CLI::App* command =
      app.add_subcommand("case", "Make a case of OpenFOAM for wind or for a room, which runs, of a mesh");
  command->fallthrough(); // to --config
  auto options = std::make_shared<CaseOptions>();
  declareCaseOptions(*command, *options);
  declareConfigFile(*command, options->writeConfig, "make no case");
  command->footer(examples);
  command->callback([options, command, &console, &status] { status = runCase(*options, *command, console); });
}

} // namespace atria::tool
