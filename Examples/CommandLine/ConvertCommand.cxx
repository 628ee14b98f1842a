// SPDX-License-Identifier: GPL-3.0-or-later
/// atria convert: writes a mesh on file in formats of solvers.
#include "Commands.h"
#include "Console.h"
#include "ExportOptions.h"
#include "InputFiles.h"

#include <vtkPartitionedDataSetCollection.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <memory>

namespace atria::tool {

namespace {

struct Options
{
  std::string file;
  std::string patches;
  ExportOptions exports;
};

ExitStatus runConvert(const Options& options, Console& console, const Workers& workers)
{
  if (options.exports.targets().empty())
  {
    throw Failure(Usage, "nothing to write; give --openfoam, --fluent, --cgns, --su2, --gmsh or --abaqus");
  }
  checkExportOptions(options.exports);
  const auto mesh = readMesh(options.file, console);
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches;
  if (!options.patches.empty())
  {
    patches = readPatches(options.patches, console);
  }
  writeExports(options.exports, {mesh, patches}, false, console, workers);
  console.clearBar();
  return Done;
}

} // namespace

void addConvertCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status)
{
  CLI::App* command = app.add_subcommand("convert", "Write a mesh in formats of solvers");
  auto options = std::make_shared<Options>();
  command->add_option("MESH.vtu", options->file, "Mesh to write")->required();
  command
      ->add_option("--patches", options->patches,
                   "Its patches, as `atria mesh --patches` writes them (default: those recorded in it)")
      ->type_name("IN.vtpc");
  declareExportOptions(*command, options->exports);
  command->callback([options, &console, &workers, &status] { status = runConvert(*options, console, workers); });
}

} // namespace atria::tool
