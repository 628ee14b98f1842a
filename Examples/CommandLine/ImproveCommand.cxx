// SPDX-License-Identifier: GPL-3.0-or-later
/// atria improve: moves the points of a mesh on file until its elements are valid and good.
#include "Commands.h"
#include "Console.h"
#include "ExportOptions.h"
#include "Files.h"
#include "InputFiles.h"
#include "MeshSums.h"
#include "Numbers.h"
#include "OutputFiles.h"
#include "Report.h"
#include "Threads.h"

#include <vtkAtriaMeshOptimizer.h>
#include <vtkAtriaMeshQuality.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>
#include <memory>

namespace atria::tool {

namespace {

struct Options
{
  std::string file;
  std::string output;
  std::string patches;
  std::string patchesOutput;
  ExportOptions exports;
  double featureAngle = 30.0;
  bool fixBoundary = false;
  double squish = 0.8;
  double nonOrthogonality = 60.0;
  double skewness = 2.0;
  double scaledJacobian = 0.3;
  int sweeps = 50;
  int threads = 0;
  bool json = false;
};

void checkOptions(const Options& options)
{
  checkOutput("--output", options.output, ".vtu");
  checkExportOptions(options.exports);
  if (!options.patchesOutput.empty())
  {
    checkOutput("--patches-output", options.patchesOutput, ".vtpc");
  }
}

/// Returns {quality, invalid_elements}.
Json measure(vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches, const std::string& about,
             Console& console)
{
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputDataObject(0, mesh);
  if (patches)
  {
    quality->SetInputDataObject(1, patches);
  }
  updateOrFail(quality, about, console);
  return {{"quality", qualityOf(quality->GetSummary())}, {"invalid_elements", quality->GetNumberOfInvalidCells()}};
}

void printTable(const Json& report)
{
  const Json& before = report["before"];
  const Json& after = report["after"];
  std::printf("%-20s %14lld\n", "points moved", report["moved_points"].get<long long>());
  const auto counts = [&](const char* label, const char* name) {
    std::printf("%-20s %14lld -> %lld\n", label, before[name].get<long long>(), after[name].get<long long>());
  };
  counts("elements below aim", "poor_elements");
  counts("invalid elements", "invalid_elements");
  std::printf("\n%-20s %14s %14s %14s %14s\n", "metric", "min before", "after", "max before", "after");
  for (const auto& [name, was] : before["quality"].items())
  {
    const Json& is = after["quality"][name];
    std::printf("%-20s %14.6g %14.6g %14.6g %14.6g\n", name.c_str(), was["min"].get<double>(), is["min"].get<double>(),
                was["max"].get<double>(), is["max"].get<double>());
  }
}

void applyOptions(vtkAtriaMeshOptimizer* optimizer, const Options& options)
{
  optimizer->SetFeatureAngle(options.featureAngle);
  optimizer->SetFixBoundary(options.fixBoundary);
  optimizer->SetTargetCellSquish(options.squish);
  optimizer->SetTargetNonOrthogonality(options.nonOrthogonality);
  optimizer->SetTargetSkewness(options.skewness);
  optimizer->SetTargetScaledJacobian(options.scaledJacobian);
  optimizer->SetNumberOfSweeps(options.sweeps);
}

/// Returns the result of writeExports(), null if no case is written.
Json writeFiles(vtkAtriaMeshOptimizer* optimizer, const Options& options, Console& console, const Workers& workers)
{
  writeMesh(options.output, optimizer->GetOutput(), console);
  if (!options.patchesOutput.empty())
  {
    writePatches(options.patchesOutput, optimizer->GetPatches(), console);
  }
  // Without patches those recorded in the mesh are written.
  vtkPartitionedDataSetCollection* patches = options.patches.empty() ? nullptr : optimizer->GetPatches();
  return writeExports(options.exports, {optimizer->GetOutput(), patches}, false, console, workers);
}

ExitStatus runImprove(const Options& options, Console& console, const Workers& workers)
{
  checkOptions(options);
  setThreads(options.threads);
  const auto mesh = readMesh(options.file, console);
  vtkNew<vtkAtriaMeshOptimizer> optimizer;
  optimizer->SetInputDataObject(0, mesh);
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches;
  if (!options.patches.empty())
  {
    patches = readPatches(options.patches, console);
    optimizer->SetInputDataObject(1, patches);
  }
  applyOptions(optimizer, options);
  console.follow(optimizer, 0.5, 0.9);
  updateOrFail(optimizer, options.file, console);
  Json report;
  report["counts"] = countsOf(mesh);
  report["moved_points"] = optimizer->GetNumberOfMovedPoints();
  report["before"] = measure(mesh, patches, options.file, console);
  report["before"]["poor_elements"] = optimizer->GetNumberOfPoorCellsBefore();
  report["after"] =
      measure(optimizer->GetOutput(), patches ? optimizer->GetPatches() : nullptr, options.output, console);
  report["after"]["poor_elements"] = optimizer->GetNumberOfPoorCells();
  report["openfoam"] = writeFiles(optimizer, options, console, workers);
  console.clearBar();
  if (options.json)
  {
    std::cout << report.dump(2) << '\n';
  }
  else
  {
    printTable(report);
  }
  const bool checksFail = !report["openfoam"].is_null() && report["openfoam"]["failed_checks"].get<int>() > 0;
  return statusOf(report["after"]["invalid_elements"].get<long long>(), checksFail);
}

void addTargets(CLI::App& command, Options& options)
{
  const auto target = [&](const char* name, double& value, double least, double most, const char* text) {
    command.add_option(name, value, text)->capture_default_str()->check(numberIn(least, most));
  };
  target("--squish", options.squish, 0.0, 0.999, "Cell squish that is good enough");
  target("--non-orthogonality", options.nonOrthogonality, 1.0, 89.9, "Non-orthogonality that is, degrees");
  target("--skewness", options.skewness, 0.01, 1000.0, "Skewness that is");
  target("--scaled-jacobian", options.scaledJacobian, 0.0, 1.0, "Scaled Jacobian that is, where there is one");
}

} // namespace

void addImproveCommand(CLI::App& app, Console& console, const Workers& workers, ExitStatus& status)
{
  CLI::App* command = app.add_subcommand(
      "improve", "Move the points of any mesh until its elements are good; exit status 4 if some are not valid then, 5 "
                 "if the OpenFOAM case fails a check");
  auto options = std::make_shared<Options>();
  command->add_option("MESH.vtu", options->file, "Mesh to improve")->required();
  command->add_option("-o,--output", options->output, "Where the mesh goes, a .vtu file")
      ->required()
      ->type_name("OUT.vtu");
  auto* patches = command->add_option("--patches", options->patches,
                                      "Its patches, as `atria mesh --patches` writes them; edges between them are kept "
                                      "(default: those recorded in it)");
  patches->type_name("IN.vtpc");
  command->add_option("--patches-output", options->patchesOutput, "Also write the patches as they are then")
      ->needs(patches)
      ->type_name("OUT.vtpc");
  declareExportOptions(*command, options->exports);
  command
      ->add_option("--feature-angle", options->featureAngle,
                   "Edges of the boundary that turn by more are kept, degrees")
      ->capture_default_str()
      ->check(numberIn(0.0, 180.0));
  command->add_flag("--fix-boundary", options->fixBoundary, "Leave points on the boundary where they are");
  addTargets(*command, *options);
  command->add_option("--sweeps", options->sweeps, "How often at most all points in question are looked at")
      ->capture_default_str()
      ->check(numberIn(1, 10000));
  command->add_option("--threads", options->threads, "Number of threads (default: all cores)")
      ->check(numberIn(1, 1024))
      ->type_name("N");
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &console, &workers, &status] { status = runImprove(*options, console, workers); });
}

} // namespace atria::tool
