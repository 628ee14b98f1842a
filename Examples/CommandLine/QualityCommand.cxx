// SPDX-License-Identifier: GPL-3.0-or-later
/// atria quality: prints counts, metrics and validity of a mesh on file; draws charts; writes its worst elements.
#include "Commands.h"
#include "Console.h"
#include "Files.h"
#include "InputFiles.h"
#include "MeshSums.h"
#include "Numbers.h"
#include "OutputFiles.h"
#include "QualityPlot.h"
#include "Report.h"

#include <vtkAtriaMeshQuality.h>
#include <vtkAtriaOpenFOAMWriter.h>
#include <vtkAtriaWorstElements.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

namespace atria::tool {

namespace {

struct Options
{
  std::string file;
  std::string patches;
  bool json = false;
  bool checks = false;
  std::vector<std::string> plots;
  std::string output;
  std::optional<int> worst;
  std::optional<double> beyond;
  std::string metric = "CellSquish";
  int rings = 1;

  bool wantsWorst() const { return worst || beyond; }
};

void printChecks(const Json& checks)
{
  std::printf("\n%-22s %-7s %12s %14s %12s\n", "check", "of", "limit", "worst", "failing");
  for (const auto& [name, check] : checks.items())
  {
    const Json& worst = check["worst"];
    std::printf("%-22s %-7s %12.6g %14.6g %12lld%s\n", name.c_str(), check["of"].get<std::string>().c_str(),
                check["limit"].get<double>(), worst.get<double>(), check["failing"].get<long long>(),
                check["failing"].get<long long>() == 0 ? ""
                : check["is_error"].get<bool>()        ? "  FAILED"
                                                       : "  noted");
  }
}

void printTable(const Json& report)
{
  for (const auto& [name, count] : report["counts"].items())
  {
    std::printf("%-20s %14lld\n", name.c_str(), count.get<long long>());
  }
  std::printf("%-20s %14lld\n\n", "invalid elements", report["invalid_elements"].get<long long>());
  std::printf("%-20s %14s %14s %14s %14s\n", "metric", "min", "max", "mean", "std");
  for (const auto& [name, value] : report["quality"].items())
  {
    std::printf("%-20s %14.6g %14.6g %14.6g %14.6g\n", name.c_str(), value["min"].get<double>(),
                value["max"].get<double>(), value["mean"].get<double>(), value["std"].get<double>());
  }
  if (report.contains("checks"))
  {
    printChecks(report["checks"]);
    std::printf("\nfailed checks of checkMesh -allGeometry: %d\n", report["failed_checks"].get<int>());
    std::printf("judged as --openfoam writes it, with cells and faces merged; without that fail: %d\n",
                report["unmerged"]["failed_checks"].get<int>());
  }
}

void checkOptions(const Options& options)
{
  for (const std::string& plot : options.plots)
  {
    checkOutput("--plot", plot, std::filesystem::path(plot).extension() == ".png" ? ".png" : ".html");
  }
  if (!options.output.empty())
  {
    checkOutput("--output", options.output, ".vtu");
  }
  if (options.wantsWorst() && options.output.empty())
  {
    throw Failure(Usage, "--worst and --beyond need --output FILE.vtu for what they extract");
  }
}

void writeWorst(vtkAtriaMeshQuality* quality, const Options& options, Console& console)
{
  vtkNew<vtkAtriaWorstElements> worst;
  worst->SetInputConnection(quality->GetOutputPort());
  worst->SetMetricName(options.metric);
  worst->SetNumberOfElements(options.worst.value_or(1));
  worst->SetUseLimit(options.beyond.has_value());
  worst->SetLimit(options.beyond.value_or(0.0));
  worst->SetRings(options.rings);
  updateOrFail(worst, "--metric " + options.metric, console);
  writeMesh(options.output, worst->GetOutput(), console);
}

/// Adds checkMesh's results for the mesh as OpenFOAM's writer writes it, and for the mesh as it is. Returns the number
/// of failed checks in the written mesh.
int addChecks(vtkAtriaMeshQuality* quality, vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches,
              const Options& options, Console& console, Json& report)
{
  vtkNew<vtkAtriaOpenFOAMWriter> writer;
  writer->SetInputDataObject(0, mesh);
  if (patches)
  {
    writer->SetInputDataObject(1, patches);
  }
  writer->Judge();
  throwIfErrors(console, BadInput, options.file);
  Console::throwIfInterrupted();
  report["checks"] = checksOf(writer->GetChecks());
  report["failed_checks"] = writer->GetNumberOfFailedChecks();
  report["unmerged"] = {{"checks", checksOf(quality->GetChecks())},
                        {"failed_checks", quality->GetNumberOfFailedChecks()}};
  return writer->GetNumberOfFailedChecks();
}

void writeFiles(vtkAtriaMeshQuality* quality, const Options& options, Console& console)
{
  for (const std::string& plot : options.plots)
  {
    const std::string title = "Quality of " + std::filesystem::path(options.file).filename().string();
    writeQualityPlot(plot, title, quality->GetSummary(), quality->GetHistogram());
  }
  if (options.wantsWorst())
  {
    writeWorst(quality, options, console);
  }
  else if (!options.output.empty())
  {
    writeMesh(options.output, quality->GetOutput(), console);
  }
}

ExitStatus runQuality(const Options& options, Console& console)
{
  checkOptions(options);
  const auto mesh = readMesh(options.file, console);
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputDataObject(0, mesh);
  vtkSmartPointer<vtkPartitionedDataSetCollection> patches;
  if (!options.patches.empty())
  {
    patches = readPatches(options.patches, console);
    quality->SetInputDataObject(1, patches);
  }
  quality->SetCheckMesh(options.checks);
  console.follow(quality, 0.5, 1.0);
  updateOrFail(quality, options.file, console);
  writeFiles(quality, options, console);
  console.clearBar();

  Json report;
  report["counts"] = countsOf(mesh);
  report["quality"] = qualityOf(quality->GetSummary());
  report["invalid_elements"] = quality->GetNumberOfInvalidCells();
  const int failedChecks = options.checks ? addChecks(quality, mesh, patches, options, console, report) : 0;
  if (options.json)
  {
    std::cout << report.dump(2) << '\n';
  }
  else
  {
    printTable(report);
  }
  return statusOf(quality->GetNumberOfInvalidCells(), failedChecks > 0);
}

} // namespace

void addQualityCommand(CLI::App& app, Console& console, ExitStatus& status)
{
  CLI::App* command = app.add_subcommand(
      "quality", "Measure a mesh; exit status 4 if it has elements that are not valid, 5 if it fails "
                 "what --checks judges");
  auto options = std::make_shared<Options>();
  command->add_option("MESH.vtu", options->file, "Mesh to measure")->required();
  command->add_option(
      "--patches", options->patches,
      "FILE.vtpc with the mesh's patches: parts the two sides of sheets one element wide (default: those "
      "recorded in the mesh)");
  command->add_flag("--json", options->json, "Print JSON");
  command->add_flag("--checks", options->checks,
                    "Judge the mesh as OpenFOAM's checkMesh -allGeometry does what --openfoam writes of it");
  command
      ->add_option(
          "--plot", options->plots,
          "Charts of all metrics and the table: FILE.html, which needs no other file, or FILE.png; may be repeated")
      ->allow_extra_args(false);
  command->add_option(
      "-o,--output", options->output,
      "FILE.vtu for the mesh with an array for each metric; with --worst or --beyond for what they extract");
  auto* worst = command->add_option("--worst", options->worst, "Extract the N worst elements with those about them");
  worst->check(atLeast(1));
  command->add_option("--beyond", options->beyond, "Extract all elements whose metric is worse than this")
      ->excludes(worst);
  command->add_option("--metric", options->metric, "Array that --worst and --beyond go by")->capture_default_str();
  command->add_option("--rings", options->rings, "Rings of elements about the worst")
      ->check(numberIn(0, 100))
      ->capture_default_str();
  command->callback([options, &console, &status] { status = runQuality(*options, console); });
}

} // namespace atria::tool
