// SPDX-License-Identifier: GPL-3.0-or-later
/// atria mesh: reader, mesher, quality and writers in a row.
#include "Commands.h"
#include "Console.h"
#include "Files.h"
#include "LayerOptions.h"
#include "LeftOut.h"
#include "Report.h"
#include "SizeOptions.h"
#include "Threads.h"

#include <vtkAtriaDualMesher.h>
#include <vtkAtriaMeshQuality.h>
#include <vtkAtriaOctreeSource.h>
#include <vtkAtriaPreflight.h>
#include <vtkAtriaSurfaceReader.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPartitionedDataSetCollection.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnstructuredGrid.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <tuple>
#include <vector>

namespace atria::tool {

namespace {

struct MeshOptions
{
  std::string input;
  ModelOptions model;
  std::string output;
  double sizeMax = 0.0;
  double sizeMid = 0.0;
  double sizeMin = 0.0;
  SizeOptions sizes;
  LayerOptions layers;
  bool estimate = false;
  double gap = 0.0;
  double smallParts = 0.0;
  double crack = 0.0;
  std::vector<double> domain;
  std::string site;
  bool automatic = false; ///< the default, too
  bool modelBounds = false;
  double domainAngle = 0.0;
  double wind = 0.0;
  std::string terrain;
  std::string align = "axes";
  bool preflight = false;
  std::string zone = "outside";
  std::vector<std::tuple<double, double, double>> seeds;
  std::vector<std::tuple<double, double, double>> sealedSeeds;
  std::string patches;
  std::string openfoam;
  bool restoreOffset = false;
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

void declareSiteOptions(CLI::App& command, MeshOptions& options, CLI::Option* domain, CLI::Option* site)
{
  auto* bounds = command.add_flag("--model-bounds", options.modelBounds,
                                  "Domain: the model's bounds, for rooms and channels whose walls are its sides");
  bounds->excludes(domain)->excludes(site);
  auto* automatic =
      command.add_flag("--automatic", options.automatic,
                       "Domain from the buildings' height H: 5 H, behind them 15 H, blockage at most 3 % (default)");
  automatic->excludes(domain)->excludes(site)->excludes(bounds);
  command
      .add_option("--wind", options.wind,
                  "Where the wind blows to, degrees from x, counterclockwise from above; for --automatic")
      ->excludes(domain)
      ->excludes(site)
      ->excludes(bounds)
      ->check(CLI::Range(-360.0, 360.0))
      ->type_name("DEG");
  command
      .add_option("--domain-angle", options.domainAngle,
                  "Turns the domain, degrees counterclockwise from above; for --domain, --site and --model-bounds")
      ->excludes(automatic)
      ->check(CLI::Range(-180.0, 180.0))
      ->type_name("DEG");
  command
      .add_option("--terrain", options.terrain,
                  "Names of terrain surfaces, with * and ?; extended to the domain's sides")
      ->type_name("PATTERN");
  command.add_option("--align", options.align, "What the grid stands along")
      ->capture_default_str()
      ->check(CLI::IsMember({"axes", "walls", "domain"}))
      ->type_name("axes|walls|domain");
  command.add_flag(
      "--preflight", options.preflight,
      "Print domain, blockage, narrowest places and elements to expect, and make no mesh; --report writes them");
}

void declareOptions(CLI::App& command, MeshOptions& options)
{
  // The filter is the one home of the defaults.
  vtkNew<vtkAtriaDualMesher> mesher;
  options.sizeMax = mesher->GetSizeMax();
  options.sizeMid = mesher->GetSizeMid();
  options.sizeMin = mesher->GetSizeMin();
  options.gap = mesher->GetGapTolerance();
  options.smallParts = mesher->GetSmallPartSize();
  options.crack = mesher->GetCrackTolerance();

  command.add_option("MODEL", options.input, modelFormats)->required();
  declareModelOptions(command, options.model);
  command
      .add_option("-o,--output", options.output,
                  "Where the mesh goes, a .vtu file (not for --preflight and --estimate)")
      ->type_name("OUT.vtu");
  const auto size = [&](const char* name, double& value, const char* text) {
    command.add_option(name, value, text)->capture_default_str()->check(CLI::PositiveNumber)->type_name("M");
  };
  size("--size-max", options.sizeMax, "Element size away from surfaces, meters");
  size("--size-mid", options.sizeMid, "Element size at surfaces, meters");
  size("--size-min", options.sizeMin, "Element size at edges, corners and close surfaces, meters; the grid's unit");
  declareSizeOptions(command, options.sizes);
  declareLayerOptions(command, options.layers);
  command.add_flag("--estimate", options.estimate, "Print octants by size, elements and memory, and make no mesh");
  command
      .add_option("--gap", options.gap,
                  "Gaps narrower than this are closed, meters; 0 closes none (default: 0.05 of --size-min)")
      ->check(CLI::NonNegativeNumber)
      ->type_name("M");
  command
      .add_option("--small-parts", options.smallParts,
                  "Parts of the model smaller than this many octants of --size-min are left out, but for surfaces that "
                  "size rules name; 0 leaves out none")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber)
      ->type_name("N");
  command
      .add_option("--crack", options.crack,
                  "Gaps beside free edges no wider than this part of the octants there are closed; 0 closes none")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 0.9))
      ->type_name("PART");
  auto* domain = command.add_option("--domain", options.domain, "Bounds of the domain, meters")
                     ->expected(6)
                     ->type_name("X0 X1 Y0 Y1 Z0 Z1");
  auto* site = command
                   .add_option("--site", options.site,
                               "Surface whose rectangle is the domain's ground; height 0.3 of its longer side")
                   ->type_name("NAME");
  site->excludes(domain);
  declareSiteOptions(command, options, domain, site);
  auto* zone =
      command
          .add_option("--zone", options.zone,
                      "Fluid is what the domain's top reaches, or its other sides if nothing does, or all there is")
          ->capture_default_str()
          ->check(CLI::IsMember({"outside", "all"}))
          ->type_name("outside|all");
  command.add_option("--seed", options.seeds, "Fluid is what this point reaches; may be repeated")
      ->allow_extra_args(false)
      ->type_name("X Y Z")
      ->excludes(zone);
  command
      .add_option("--sealed-seed", options.sealedSeeds,
                  "Point in a space that should be closed; a way out is warned of; may be repeated")
      ->allow_extra_args(false)
      ->type_name("X Y Z");
  command.add_option("--patches", options.patches, "Also write the named boundary patches")->type_name("OUT.vtpc");
  command.add_option("--openfoam", options.openfoam, "Also write an OpenFOAM case with the mesh")->type_name("DIR");
  command.add_flag("--restore-offset", options.restoreOffset,
                   "Write the OpenFOAM case where the model was before --recenter moved it");
  command
      .add_option("--report", options.report,
                  "Also write counts, zones, leaks, patches, quality, repairs and times as JSON")
      ->type_name("OUT.json");
  command.add_option("--threads", options.threads, "Number of threads (default: all cores)")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
}

void checkOptions(const MeshOptions& options)
{
  if (options.output.empty() && !options.preflight && !options.estimate)
  {
    throw Failure(Usage, "--output is required, unless --preflight or --estimate is given");
  }
  if (!options.output.empty())
  {
    checkOutput("--output", options.output, ".vtu");
  }
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
  if (options.domainAngle != 0.0 && options.domain.empty() && options.site.empty() && !options.modelBounds)
  {
    throw Failure(Usage, "--domain-angle needs --domain, --site or --model-bounds: the automatic domain stands along "
                         "--wind");
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

/// Without an option the domain is the filter's default, the automatic one.
void configureGrid(vtkAtriaGridAlgorithm* filter, const MeshOptions& options)
{
  filter->SetSizeMax(options.sizeMax);
  filter->SetSizeMid(options.sizeMid);
  filter->SetSizeMin(options.sizeMin);
  configureSizes(filter, options.sizes);
  filter->SetGapTolerance(options.gap);
  filter->SetSmallPartSize(options.smallParts);
  if (!options.domain.empty())
  {
    filter->SetDomainMode(vtkAtriaGridAlgorithm::Explicit);
    filter->SetDomainBounds(options.domain.data());
  }
  if (!options.site.empty())
  {
    filter->SetDomainMode(vtkAtriaGridAlgorithm::Site);
    filter->SetSiteName(options.site.c_str());
  }
  if (options.modelBounds)
  {
    filter->SetDomainMode(vtkAtriaGridAlgorithm::FromSurfaces);
  }
  filter->SetWindAngle(options.wind);
  filter->SetDomainAngle(options.domainAngle);
  filter->SetTerrainName(options.terrain.c_str());
  filter->SetAlignGrid(options.align == "walls"    ? vtkAtriaGridAlgorithm::ToWalls
                       : options.align == "domain" ? vtkAtriaGridAlgorithm::ToDomain
                                                   : vtkAtriaGridAlgorithm::ToAxes);
}

void configure(vtkAtriaDualMesher* mesher, const MeshOptions& options)
{
  configureGrid(mesher, options);
  mesher->SetCrackTolerance(options.crack);
  mesher->SetZoneRule(options.zone == "all" ? vtkAtriaDualMesher::All : vtkAtriaDualMesher::Outside);
  if (!options.seeds.empty())
  {
    mesher->SetZoneRule(vtkAtriaDualMesher::Seeds);
    for (const auto& [x, y, z] : options.seeds)
    {
      mesher->AddSeed(x, y, z);
    }
  }
  for (const auto& [x, y, z] : options.sealedSeeds)
  {
    mesher->AddSealedSeed(x, y, z);
  }
  configureLayers(mesher, options.layers);
}

Json makeReport(vtkAtriaDualMesher* mesher, vtkAtriaMeshQuality* quality, const Json& seconds)
{
  auto* mesh = vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0));
  auto* diagnostics = vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2));
  Json report;
  report["counts"] = countsOf(mesh);
  report["zones"] = zonesOf(mesh, diagnostics);
  report["leaks"] = leaksOf(diagnostics);
  report["patches"] = patchesOf(vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1)));
  report["quality"] = qualityOf(vtkTable::SafeDownCast(quality->GetOutputDataObject(1)));
  report["invalid_elements"] = quality->GetNumberOfInvalidCells();
  report["max_level"] = maxLevelOf(mesh);
  report["seconds"] = seconds;
  report["peak_memory_bytes"] = peakMemoryBytes();
  report["threads"] = threadsInUse();
  report["repair"] = repairOf(diagnostics);
  report["hidden_detail"] = hiddenDetailOf(diagnostics);
  report["layers"] = layersOf(diagnostics);
  report["diagnostics"] = diagnosticsOf(diagnostics);
  return report;
}

void warnOfLeaks(vtkPolyData* diagnostics, const std::string& input, Console& console)
{
  for (const Json& leak : leaksOf(diagnostics))
  {
    console.warning(input + ": " + leak["message"].get<std::string>());
  }
}

/// Returns what was merged in the OpenFOAM case.
MergedParts writeOutputs(const MeshOptions& options, vtkUnstructuredGrid* mesh,
                         vtkPartitionedDataSetCollection* patches, Console& console)
{
  MergedParts merged;
  writeMesh(options.output, mesh, console);
  if (!options.patches.empty())
  {
    writePatches(options.patches, patches, console);
  }
  if (!options.openfoam.empty())
  {
    merged = writeOpenFOAM(options.openfoam, mesh, patches, options.restoreOffset, console);
  }
  return merged;
}

ExitStatus runPreflight(const MeshOptions& options, vtkAtriaSurfaceReader* reader, Console& console)
{
  vtkNew<vtkAtriaPreflight> preflight;
  configureGrid(preflight, options);
  preflight->SetInputConnection(0, reader->GetOutputPort());
  console.follow(preflight, 0.05, 1.0);
  updateOrFail(preflight, options.input, console);
  const Json report = preflightOf(preflight->GetOutput());
  console.clearBar();
  printPreflight(preflight->GetOutput());
  for (const Json& warning : report["warnings"])
  {
    console.warning(options.input + ": " + warning.get<std::string>());
  }
  if (!options.report.empty())
  {
    writeText(options.report, report.dump(2) + "\n");
  }
  return Done;
}

ExitStatus printEstimate(const MeshOptions& options, vtkAtriaSurfaceReader* reader, Console& console)
{
  vtkNew<vtkAtriaOctreeSource> source;
  configureGrid(source, options);
  source->SetInputConnection(reader->GetOutputPort());
  console.follow(source, 0.05, 1.0);
  const bool estimated = source->Estimate();
  console.clearBar();
  if (!estimated)
  {
    throwIfErrors(console, BadInput, options.input);
  }
  std::istringstream warnings(source->GetEstimateWarning());
  for (std::string warning; std::getline(warnings, warning);)
  {
    console.warning(warning);
  }
  std::cout << estimateText(source);
  return Done;
}

ExitStatus runMesh(const MeshOptions& options, Console& console)
{
  checkOptions(options);
  setThreads(options.threads);
  const Stopwatch total;

  const Stopwatch reading;
  const auto reader = readModel(options.input, options.model, console);
  const double readSeconds = reading.seconds();
  if (!options.site.empty())
  {
    checkSite(options.site, reader->GetOutput());
  }
  if (options.preflight)
  {
    return runPreflight(options, reader, console);
  }
  if (options.estimate)
  {
    return printEstimate(options, reader, console);
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
  const MergedParts merged =
      writeOutputs(options, vtkUnstructuredGrid::SafeDownCast(quality->GetOutputDataObject(0)),
                   vtkPartitionedDataSetCollection::SafeDownCast(mesher->GetOutputDataObject(1)), console);

  Json seconds = {{"Read", readSeconds}};
  seconds.update(stageSecondsOf(mesher));
  seconds["Quality"] = qualitySeconds;
  seconds["Write"] = writing.seconds();
  seconds["Total"] = total.seconds();
  if (!options.report.empty())
  {
    Json report = makeReport(mesher, quality, seconds);
    report["openfoam"] =
        options.openfoam.empty()
            ? Json()
            : Json{{"merged_cells", merged.cells}, {"added_cells", merged.addedCells}, {"merged_faces", merged.faces}};
    writeText(options.report, report.dump(2) + "\n");
  }
  console.clearBar();
  if (merged.cells > 0)
  {
    std::cout << options.openfoam << ": " << merged.cells
              << " cells fewer, as elements with too few neighbors were made one with one of them\n";
  }
  if (merged.addedCells > 0)
  {
    std::cout << options.openfoam << ": " << merged.addedCells
              << " cells more, as elements with too few neighbors were cut into pyramids\n";
  }
  if (merged.faces > 0)
  {
    std::cout << options.openfoam << ": " << merged.faces
              << " faces fewer, as coplanar ones of an element were merged\n";
  }
  printLayers(vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2)));
  if (mesher->GetZoneRule() == vtkAtriaDualMesher::Outside) // with seeds it was chosen what is left out
  {
    tellLeftOut(zonesOf(plainMesh, vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2))), options.input, console);
  }
  warnOfLeaks(vtkPolyData::SafeDownCast(mesher->GetOutputDataObject(2)), options.input, console);
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
