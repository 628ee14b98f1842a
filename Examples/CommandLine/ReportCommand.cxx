// SPDX-License-Identifier: GPL-3.0-or-later
/// atria report: makes a page of the results of a case's runs, with a Python package.
#include "Commands.h"
#include "Console.h"
#include "Numbers.h"
#include "Platform.h"

#include <CLI/CLI.hpp>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace atria::tool {

namespace {

namespace fs = std::filesystem;

struct Options
{
  std::string folder;
  std::string output;
  std::string climate;
  std::vector<double> station;
};

constexpr const char* examples = R"(Examples:
  case/Allrun && atria report case
      case/report.html: air changes of rooms, pictures, convergence, and what to doubt
  atria report rose --climate climate.csv --station 10 0.03
      also classes of wind comfort, of a case with many directions and a climate that was measured 10 m above grass)";

/// The interpreter's program; it names a package that it cannot load.
constexpr const char* script = R"(import sys
try:
    from atria.report.__main__ import main
except ImportError as error:
    sys.exit(f"atria: error: {sys.executable}: {error}; let ATRIA_PYTHON name the Python whose VTK Atria was built for")
sys.exit(main())
)";

/// Returns the folder of the package `atria`: beside this program, in the tree of a build or of an installation.
fs::path packages()
{
  const fs::path program = programFile();
  fs::path found = program.parent_path().parent_path() / "lib" / "python3" / "dist-packages";
  if (program.empty() || !fs::exists(found / "atria" / "report" / "__main__.py"))
  {
    throw Failure(Failed, "the page is made by Atria's Python package, which is not in '" + found.string() +
                              "': build Atria with its Python package, or install python3-atria");
  }
  return found;
}

/// Returns the interpreter of the package: the system's, whose VTK it uses, unless ATRIA_PYTHON names another.
std::string interpreter()
{
  const char* const chosen = std::getenv("ATRIA_PYTHON");
  return chosen && *chosen ? chosen : ATRIA_DEFAULT_PYTHON;
}

std::vector<std::string> commandOf(const Options& options)
{
  std::vector<std::string> command{interpreter(), "-c", script};
  if (!options.output.empty())
  {
    command.insert(command.end(), {"--output", options.output});
  }
  if (!options.climate.empty())
  {
    command.insert(command.end(), {"--climate", options.climate});
  }
  if (!options.station.empty())
  {
    command.push_back("--station");
    for (const double value : options.station)
    {
      command.push_back(CLI::detail::to_string(value));
    }
  }
  command.insert(command.end(), {"--", options.folder});
  return command;
}

/// Continues as the interpreter, whose exit status is that of the command.
[[noreturn]] void runReport(const Options& options)
{
  prependPath("PYTHONPATH", packages().string());
  const std::vector<std::string> command = commandOf(options);
  throw Failure(Failed, "cannot run '" + command[0] + "': " + becomeProgram(command) +
                            "; let ATRIA_PYTHON name the Python that has VTK");
}

} // namespace

void addReportCommand(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("report", "Make a page of what the runs of a case say: air changes, comfort");
  auto options = std::make_shared<Options>();
  command->add_option("CASE", options->folder, "Folder that `atria case` wrote and whose Allrun has run")->required();
  command->add_option("-o,--output", options->output, "Where the page goes (default: CASE/report.html)")
      ->type_name("PAGE.html");
  auto* climate = command
                      ->add_option("--climate", options->climate,
                                   "Statistics of the wind, for classes of comfort: .csv or .json with the columns "
                                   "from (degrees clockwise from north), frequency, scale (m/s) and shape (Weibull)")
                      ->type_name("FILE");
  command
      ->add_option("--station", options->station,
                   "Where the climate was measured: height above the ground and roughness length there, meters "
                   "(default: as the wind of the case)")
      ->expected(2)
      ->check(positive())
      ->needs(climate)
      ->type_name("HEIGHT ROUGHNESS");
  command->footer(examples);
  command->callback([options] { runReport(*options); });
}

} // namespace atria::tool
