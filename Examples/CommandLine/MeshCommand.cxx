// SPDX-License-Identifier: GPL-3.0-or-later
/// atria mesh: reader, mesher, quality and writers in a row.
#include "Commands.h"
#include "Console.h"
#include "Files.h"
#include "Report.h"
#include "Threads.h"

#include <vtkAtriaDualMesher.h>
#include <vtkAtriaMeshQuality.h>
#include <vtkAtriaVRMLReader.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <array>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <tuple>
#include <vector>

namespace atria::tool {

namespace {

struct MeshOptions
{
  std::string input;
  std::string output;
  double sizeMax = 0.0;
  double sizeMid = 0.0;
  double sizeMin = 0.0;
  double gap = 0.0;
  std::vector<double> domain;
  std::string site;
  std::string zone = "outside";
  std::vector<std::tuple<double, double, double>> seeds;
  std::string patches;
  std::string openfoam;
  std::string report;
  int threads = 0;
};

class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

private:
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

void declareOptions(CLI::App& command, MeshOptions& options)
{
  // The filter is the one home of the defaults.
  vtkNew<vtkAtriaDualMesher> mesher;
  options.sizeMax = mesher->GetSizeMax();
  options.sizeMid = mesher->GetSizeMid();
  options.sizeMin = mesher->GetSizeMin();
  options.gap = mesher->GetGapTolerance();

  command.add_option("IN.wrl", options.input, "VRML model (.wrl, .wrz, .wrl.gz), in metres, Z up")->required();
  command.add_option("-o,--output", options.output, "Where the mesh goes, a .vtu file")
      ->required()
      ->type_name("OUT.vtu");
  const auto size = [&](const char* name, double& value, const char* text) {
    command.add_option(name, value, text)->capture_default_str()->check(CLI::PositiveNumber)->type_name("M");
  };
  size("--size-max", options.sizeMax, "Element size away from surfaces, metres");
  size("--size-mid", options.sizeMid, "Element size at surfaces, metres");
  size("--size-min", options.sizeMin, "Element size at edges, corners and close surfaces, metres; the grid's unit");
  command
      .add_option("--gap", options.gap,
                  "Gaps narrower than this are closed, metres; 0 closes none (default: 0.05 of --size-min)")
      ->check(CLI::NonNegativeNumber)
      ->type_name("M");
  auto* domain =
      command.add_option("--domain", options.domain, "Bounds of the domain, metres (default: those of the model)")
          ->expected(6)
          ->type_name("X0 X1 Y0 Y1 Z0 Z1");
  command
      .add_option("--site", options.site,
                  "Surface whose rectangle is the domain's ground; height 0.3 of its longer side")
      ->type_name("NAME")
      ->excludes(domain);
  auto* zone = command.add_option("--zone", options.zone, "Fluid is what the domain's sides reach, or all there is")
                   ->capture_default_str()
                   ->check(CLI::IsMember({"outside", "all"}))
                   ->type_name("outside|all");
  command.add_option("--seed", options.seeds, "Fluid is what this point reaches; may be repeated")
      ->allow_extra_args(false)
      ->type_name("X Y Z")
      ->excludes(zone);
  command.add_option("--patches", options.patches, "Also write the named boundary patches")->type_name("OUT.vtpc");
  command.add_option("--openfoam", options.openfoam, "Also write an OpenFOAM case with the mesh")->type_name("DIR");
  command
      .add_option("--report", options.report, "Also write counts, zones, patches, quality, repairs and times as JSON")
      ->type_name("OUT.json");
  command.add_option("--threads", options.threads, "Number of threads (default: all cores)")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
}

void checkOptions(const MeshOptions& options)
{
  checkOutput("--output", options.output, ".vtu");
  if (!options.patches.empty())
  {
    checkOutput("--patches", options.patches, ".vtpc");
  }
  if (!options.report.empty())
  {
    checkOutput("--report", options.report, ".json");
  }
  if (options.sizeMid < options.sizeMin || options.sizeMax < options.sizeMid)
  {
    throw Failure(Usage, "sizes must not fall from --size-min over --size-mid to --size-max; give all three");
  }
  for (int axis = 0; axis < 3 && !options.domain.empty(); ++axis)
  {
    if (options.domain[2 * axis] >= options.domain[2 * axis + 1])
    {
      throw Failure(Usage, std::string("--domain: ") + "xyz"[axis] + "0 must be less than " + "xyz"[axis] + "1");
    }
  }
}

void checkSite(const std::string& site, vtkPolyData* model)
{
  auto* names = vtkStringArray::SafeDownCast(model->GetFieldData()->GetAbstractArray("SurfaceName"));
  std::string known;
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    if (names->GetValue(i) == site)
    {
      return;
    }
    known += (known.empty() ? "" : ", ") + names->GetValue(i);
  }
  throw Failure(Usage, "--site " + site + ": the model has no surface of that name; it has " + known);
}

void configure(vtkAtriaDualMesher* mesher, const MeshOptions& options)
{
  mesher->SetSizeMax(options.sizeMax);
  mesher->SetSizeMid(options.sizeMid);
  mesher->SetSizeMin(options.sizeMin);
  mesher->SetGapTolerance(options.gap);
  if (!options.domain.empty())
  {
    mesher->SetDomainMode(vtkAtriaDualMesher::Explicit);
    mesher->SetDomainBounds(options.domain.data());
  }
  if (!options.site.empty())
  {
    mesher->SetDomainMode(vtkAtriaDualMesher::Site);
    mesher->SetSiteName(options.site.c_str());
  }
  mesher->SetZoneRule(options.zone == "all" ? vtkAtriaDualMesher::All : vtkAtriaDualMesher::Outside);
  if (!options.seeds.empty())
  {
    mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
    for (const auto& [x, y, z] : options.seeds)
    {
      mesher->AddSeed(x, y, z);
    }
  }
}

Json makeReport(vtkAtriaDualMesher* mesher, vtkAtriaMeshQuality* quality, const Json& seconds)
{
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0));
  Json report;
  report["counts"] = countsOf(mesh);
  report["zones"] = zonesOf(mesh);
  report["patches"] = patchesOf(vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1)));
  report["quality"] = qualityOf(vtkTable::SafeDownCast(quality->GetOutputDataObject(1)));
  report["invalid_elements"] = quality->GetNumberOfInvalidCells();
  report["max_level"] = maxLevelOf(mesh);
  report["seconds"] = seconds;
  report["peak_memory_bytes"] = peakMemoryBytes();
  report["threads"] = threadsInUse();
  report["repair"] = repairOf(vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2)));
  report["diagnostics"] = diagnosticsOf(vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2)));
  return report;
}

void writeOutputs(const MeshOptions& options, vtkUnstructuredGrid* mesh, vtkPartitionedDataSetCollection* patches,
                  Console& console)
{
  console.progress(0.9, "Writing");
  writeMesh(options.output, mesh, console);
  if (!options.patches.empty())
  {
    writePatches(options.patches, patches, console);
  }
  if (!options.openfoam.empty())
  {
    writeOpenFOAM(options.openfoam, mesh, patches, console);
  }
  console.progress(1.0, "Writing");
}

ExitStatus runMesh(const MeshOptions& options, Console& console)
{
  checkOptions(options);
  setThreads(options.threads);
  const Stopwatch total;

  const Stopwatch reading;
  const auto reader = readModel(options.input, console);
  const double readSeconds = reading.seconds();
  if (!options.site.empty())
  {
    checkSite(options.site, reader->GetOutput());
  }

  vtkNew<vtkAtriaDualMesher> mesher;
  configure(mesher, options);
  mesher->SetInputConnection(0, reader->GetOutputPort());
  console.follow(mesher, 0.05, 0.75);
  updateOrFail(mesher, options.input, console);
  auto* plainMesh = vtkUnstructuredGrid::SafeDownCast(mesher->GetOutputDataObject(0));
  if (!plainMesh || plainMesh->GetNumberOfCells() == 0)
  {
    throw Failure(BadInput, options.input + ": no element of the domain is fluid; check --domain, --zone and --seed");
  }

  const Stopwatch measuring;
  vtkNew<vtkAtriaMeshQuality> quality;
  quality->SetInputConnection(0, mesher->GetOutputPort(0));
  quality->SetInputConnection(1, mesher->GetOutputPort(1));
  console.follow(quality, 0.75, 0.9);
  updateOrFail(quality, options.input, console);
  const double qualitySeconds = measuring.seconds();

  const Stopwatch writing;
  writeOutputs(options, vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0)),
               vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1)), console);

  Json seconds = {{"Read", readSeconds}};
  seconds.update(stageSecondsOf(mesher));
  seconds["Quality"] = qualitySeconds;
  seconds["Write"] = writing.seconds();
  seconds["Total"] = total.seconds();
  if (!options.report.empty())
  {
    writeText(options.report, makeReport(mesher, quality, seconds).dump(2) + "\n");
  }
  console.clearBar();
  if (const auto invalid = quality->GetNumberOfInvalidCells(); invalid > 0)
  {
    console.warning(options.output + ": " + std::to_string(invalid) + " of " +
                    std::to_string(plainMesh->GetNumberOfCells()) +
                    " elements are not valid; see the cell array Valid");
    return MeshNotValid;
  }
  return Done;
}

} // namespace

void addMeshCommand(CLI::App& app, Console& console, ExitStatus& status)
{
  CLI::App* command = app.add_subcommand("mesh", "Make a volume mesh of a model");
  auto options = std::make_shared<MeshOptions>();
  declareOptions(*command, *options);
  command->callback([options, &console, &status] { status = runMesh(*options, console); });
}

} // namespace atria::tool
