// SPDX-License-Identifier: GPL-3.0-or-later
/// atria quality: counts, metrics and validity of a mesh on file.
#include "Commands.h"
#include "Console.h"
#include "Files.h"
#include "Report.h"

#include <vtkAtriaMeshQuality.h>
#include <vtkNew.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <cstdio>
#include <iostream>
#include <memory>

namespace atria::tool {

namespace {

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
}

ExitStatus runQuality(const std::string& file, bool asJson, Console& console)
{
  const auto mesh = readMesh(file, console);
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputDataObject(0, mesh);
  console.follow(quality, 0.5, 1.0);
  updateOrFail(quality, file, console);
  console.clearBar();

  Json report;
  report["counts"] = countsOf(mesh);
  report["quality"] = qualityOf(vtkTable::SafeDownCast(quality->GetOutputDataObject(1)));
  report["invalid_elements"] = quality->GetNumberOfInvalidCells();
  if (asJson)
  {
    std::cout << report.dump(2) << '\n';
  }
  else
  {
    printTable(report);
  }
  return quality->GetNumberOfInvalidCells() > 0 ? MeshNotValid : Done;
}

} // namespace

void addQualityCommand(CLI::App& app, Console& console, ExitStatus& status)
{
  struct Options
  {
    std::string file;
    bool json = false;
  };
  CLI::App* command =
      app.add_subcommand("quality", "Measure a mesh; exit status 4 if it has elements that are not valid");
  auto options = std::make_shared<Options>();
  command->add_option("MESH.vtu", options->file, "Mesh to measure")->required();
  command->add_flag("--json", options->json, "Print JSON");
  command->callback([options, &console, &status] { status = runQuality(options->file, options->json, console); });
}

} // namespace atria::tool
