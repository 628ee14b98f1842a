// SPDX-License-Identifier: GPL-3.0-or-later
#include "Commands.h"
#include "Console.h"
#include "Documents.h"
#include "ExportOptions.h"
#include "MeshOnRanks.h"
#include "Numbers.h"
#include "OutputFiles.h"
#include "Support/Memory.h"
#include "Usage.h"
#include "Workers.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <string>

namespace {

int usageStatus(const CLI::App& app, const CLI::ParseError& error)
{
  // CLI11 also reports --help this way, with status 0. Its other statuses are numbers of its own.
  return app.exit(error) == 0 ? atria::tool::Done : atria::tool::Usage;
}

/// Adds the subcommands for packagers and shells: completion and man.
void addDocuments(CLI::App& app)
{
  using namespace atria::tool;
  CLI::App* completion = app.add_subcommand("completion", "Print a completion script for a shell");
  auto shell = std::make_shared<std::string>();
  completion->add_option("SHELL", *shell, "bash, zsh or fish")->required()->check(oneOf({"bash", "zsh", "fish"}));
  completion->callback([&app, shell] { std::cout << completionFor(app, *shell); });
  app.add_subcommand("man", "Print the manual page, for man -l -")->callback([&app] { std::cout << manualOf(app); });
}

/// Later versions of CLI11 else fill the lines of texts anew, examples of commands among them.
template <typename Formatter> void keepLines(Formatter& formatter)
{
  if constexpr (requires { formatter.enable_footer_formatting(false); })
  {
    formatter.enable_footer_formatting(false);
    formatter.enable_description_formatting(false);
  }
}

/// Runs the program on one rank.
int runProgram(int argc, char** argv, const atria::tool::Workers& workers)
{
  using namespace atria::tool;
  CLI::App app(
      "Meshes architecture for flow simulation: a VRML, COLLADA, IFC, OBJ, STL, PLY, glTF or CityJSON model in, a "
      "hexahedral-dominant mesh with named patches out.\nExit status: 0 done, 2 usage, 3 bad input, 4 the "
      "mesh is written but has elements that are not valid, 5 it is written and valid but fails checks of "
      "OpenFOAM's checkMesh, 6 a case's page is written but its runs are not to be believed, 130 interrupted, 1 any "
      "other failure.");
  app.name("atria");
  keepLines(*app.get_formatter());
  app.set_version_flag("--version", ATRIA_TOOL_VERSION);
  app.require_subcommand(1);
  app.failure_message(usageMessage);
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.set_config("--config", "",
                 "Take options from a file, those of `atria mesh` from its section [mesh]; what the command "
                 "line says goes before it")
      ->type_name("FILE.toml");

  Console console;
  if (workers)
  {
    Console::catchTermination();
  }
  ExitStatus status = Done;
  addMeshCommand(app, console, workers, status);
  addInspectCommand(app, console, status);
  addQualityCommand(app, console, status);
  addImproveCommand(app, console, workers, status);
  addConvertCommand(app, console, workers, status);
  addClimateCommand(app, console, status);
  addCaseCommand(app, console, status);
  addReportCommand(app);
  addDocuments(app);
  try
  {
    app.parse(argc, argv);
    return status;
  }
  catch (const CLI::ParseError& error)
  {
    console.clearBar();
    return usageStatus(app, error);
  }
  catch (const Failure& failure)
  {
    console.error(failure.what());
    return failure.status;
  }
  catch (const std::bad_alloc&)
  {
    console.error("out of memory; choose larger sizes or a smaller domain");
  }
  catch (const std::exception& error)
  {
    console.error(error.what());
  }
  return Failed;
}

/// A worker's side of the tasks of the first rank.
class Worker
{
public:
  void operator()(const std::string& text, vtkMultiProcessController& controller)
  {
    using namespace atria::tool;
    const Json task = Json::parse(text);
    if (task.contains("make"))
    {
      makeWithOthers(task, piece, controller);
    }
    else if (task.contains("measure"))
    {
      measureWithOthers(piece, controller);
    }
    else if (task.contains("case"))
    {
      writeCaseWithOthers(task, piece, controller);
    }
    else
    {
      writePiecesWithOthers(task, piece, controller);
    }
  }

private:
  atria::tool::MeshPiece piece;
};

} // namespace

int main(int argc, char** argv)
{
  atria::keepFreedMemory();
  atria::tool::Workers workers(&argc, &argv);
  return workers.isWorker() ? workers.serve(Worker()) : workers.end(runProgram(argc, argv, workers));
}
